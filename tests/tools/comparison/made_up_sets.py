"""Three small measured sets: a level wire whose tip is photographed, as it hangs, stiffer, and seen from a turned camera."""
import json
import os

# Inserted length and the tip's place, mm, of a wire of 30 N mm2 and 0.8 g/m that is held level.
HANGING = ((100, (99.9, 0, -3.2)), (150, (148.6, 0, -16.1)), (200, (191, 0, -48)), (250, (220, 0, -95)))
STIFFER = ((100, (99.95, 0, -1.6)), (150, (149.6, 0, -8.2)), (200, (197.6, 0, -25.7)), (250, (240, 0, -59)))
TURNED = tuple((length, (x, 0.04 * x, z)) for length, (x, _, z) in HANGING)


def measurement(title, tips):
    return {
        "schema": "ostium-measurement/1", "title": title, "source": "made up",
        "instruments": [{"name": "wire", "total_length_mm": 300, "outer_radius_mm": 0.2, "inner_radius_mm": 0,
                         "sections": [{"from_tip_mm": [0, 300], "EI_Nmm2": 30, "GJ_Nmm2": 23, "kg_per_mm": 8e-7}]}],
        "environment": {"gravity_m_s2": [0, 0, -9.81], "vessel": None},
        "imaging": {"noise_sigma_mm": 0.2, "registration": "given", "tip_offset": "none"},
        "experiments": [{"id": f"e{n}", "base": {"position_mm": [0, 0, 0], "tangent": [1, 0, 0], "up": [0, 0, 1]},
                         "set": [{"inserted_length_mm": length, "roll_deg": 0}], "tip_mm": list(tip)}
                        for n, (length, tip) in enumerate(tips)],
    }


def write_sets(folder):
    """Their folders."""
    out = []
    for name, tips in (("hanging", HANGING), ("stiffer", STIFFER), ("turned", TURNED)):
        out.append(os.path.join(folder, name))
        os.makedirs(out[-1], exist_ok=True)
        with open(os.path.join(out[-1], "measurement.json"), "w", encoding="utf-8") as file:
            json.dump(measurement(f"{name} wire", tips), file)
    return out
