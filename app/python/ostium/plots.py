"""The five plots that people make first of a recording: python3 -m ostium.plots out/run.h5 -o plots.png

With --patient: pressure, rate and output, what is round the heart, what leaks. With --artery: pressure, flow behind the
lesion, ST, thrombus and air. Several recordings stand side by side.
Needs matplotlib (python3-matplotlib).
"""

import argparse

import numpy as np

import ostium


def depth(axes, run):
    """How far each tool has come."""
    for name in tools_of(run):
        axes.plot(run.signals["time_s"], run.signals[f"{name}.inserted_mm"], label=name)
    axes.set_ylabel("in the body, mm")
    axes.legend(fontsize=8, ncols=6, loc="lower left", bbox_to_anchor=(0, 1), frameon=False)


def hands(axes, run):
    """What the hand feels, smoothed over 0.1 s."""
    for name in tools_of(run):
        axes.plot(run.signals["time_s"], smoothed(run.signals[f"{name}.push_N"]), label=name)
    axes.set_ylabel("push of the hand, N")


def walls(axes, run):
    """How hard tools press on the walls, smoothed over 0.1 s."""
    for name in tools_of(run):
        axes.plot(run.signals["time_s"], smoothed(run.signals[f"{name}.wall_force_N"]), label=name)
    axes.set_ylabel("on the walls, N")


def pressure(axes, run):
    """The guide's pressure, and the inflation device."""
    axes.plot(run.signals["time_s"], run.signals["guide_mmHg"], color="C3", linewidth=0.5)
    axes.set_ylabel("at the guide's tip, mmHg", color="C3")
    gauge = axes.twinx()
    gauge.plot(run.signals["time_s"], run.signals["gauge_atm"], color="C0")
    gauge.set_ylabel("gauge, atm", color="C0")


def lumen(axes, run):
    """What treatment made of the narrowing."""
    axes.plot(run.signals["time_s"], run.signals["lesion_mld_mm"], color="C2")
    axes.plot(run.signals["time_s"], run.signals["lesion_reference_mm"], color="0.6", linestyle="--")
    axes.set_ylabel("narrowest, mm")
    axes.set_ylim(bottom=0)


def blood_pressure(axes, run):
    """The aorta's, and when something was given."""
    axes.plot(run.signals["time_s"], run.signals["aorta_mmHg"], color="C3", linewidth=0.3)
    axes.set_ylabel("in the aorta, mmHg")
    axes.set_ylim(0, 220)
    close_s, last_s, side = run.signals["time_s"][-1] / 25, -np.inf, "right"
    for event in run.events:
        if word := GIVEN.get(event["name"]):
            at_s = event["time_s"]
            side = "left" if at_s - last_s < close_s and side == "right" else "right"
            last_s = at_s
            axes.axvline(at_s, color="0.4", linewidth=0.7)
            axes.text(at_s, 216, word, rotation=90, fontsize=7, va="top", ha=side)


def rate(axes, run):
    """The heart's rate, and what it puts out."""
    axes.plot(run.signals["time_s"], run.signals["heart_rate_1_min"], color="C2")
    axes.set_ylabel("rate, 1/min", color="C2")
    axes.set_ylim(0, 180)
    output = axes.twinx()
    output.plot(run.signals["time_s"], run.signals["output_L_min"], color="C0")
    output.set_ylabel("output, L/min", color="C0")
    output.set_ylim(0, 8)


def round_the_heart(axes, run):
    """Volume and pressure in the pericardium."""
    axes.plot(run.signals["time_s"], run.signals["pericardium_mL"], color="C4")
    axes.set_ylabel("pericardium, mL", color="C4")
    axes.set_ylim(bottom=0)
    inside = axes.twinx()
    inside.plot(run.signals["time_s"], smoothed(run.signals["pericardium_mmHg"], 1000), color="C1")
    inside.set_ylabel("and mmHg", color="C1")


def leak(axes, run):
    """Out of the arteries."""
    axes.plot(run.signals["time_s"], smoothed(run.signals["leak_mL_s"], 100), color="C3")
    axes.set_ylabel("leak, mL/s")
    axes.set_ylim(bottom=0)


def supply(axes, run):
    """What comes behind the lesion, over two beats, and what the ECG says to it."""
    axes.plot(run.signals["time_s"], 100 * smoothed(run.signals["flow_share"], 170), color="C3")
    axes.set_ylabel("flow of need, %", color="C3")
    axes.set_ylim(0, 200)
    shift = axes.twinx()
    shift.plot(run.signals["time_s"], run.signals["ST_mV"], color="C2")
    shift.set_ylabel("ST shift, mV", color="C2")
    shift.set_ylim(0, 0.5)


def in_the_blood(axes, run):
    """Thrombus in the arteries, air in the muscle."""
    axes.plot(run.signals["time_s"], run.signals["thrombus_mm3"], color="C5")
    axes.set_ylabel("thrombus, mm3", color="C5")
    axes.set_ylim(0, max(10, 1.1 * run.signals["thrombus_mm3"].max()))
    air = axes.twinx()
    air.plot(run.signals["time_s"], run.signals["air_mL"], color="C0")
    air.set_ylabel("air, mL", color="C0")
    air.set_ylim(0, 1)


PLOTS = (depth, hands, walls, pressure, lumen)
OF_THE_PATIENT = (blood_pressure, rate, round_the_heart, leak)
OF_THE_ARTERY = (blood_pressure, supply, in_the_blood)
GIVEN = {"perforation": "perforation", "drain_begins": "drain", "infusion_begins": "fluid", "drug_given": "drug",
         "covered_stent": "covered stent", "shock": "shock", "compressions_begin": "compressions",
         "pacing_captures": "paced", "pulse_lost": "no pulse", "heart_stops": "asystole", "thrombus_forms": "thrombus",
         "thrombus_embolises": "embolus", "aspiration_begins": "aspirated", "air_in_artery": "air",
         "air_is_out": "air is out"}


def tools_of(run):
    """Names of the run's tools, in its order."""
    return [name.removesuffix(".inserted_mm") for name in run.signals.names if name.endswith(".inserted_mm")]


def smoothed(signal, samples=10):
    """The mean of so many samples round each; at the ends, of those that there are."""
    weight = np.ones(samples)
    return np.convolve(signal, weight, mode="same") / np.convolve(np.ones(len(signal)), weight, mode="same")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python3 -m ostium.plots", description=__doc__.split(":")[0] + ".",
                                     epilog="example: python3 -m ostium.plots out/run.h5 -o plots.png")
    parser.add_argument("recordings", nargs="+", metavar="recording")
    parser.add_argument("--patient", action="store_true", help="how the patient does, instead of the instruments")
    parser.add_argument("--artery", action="store_true", help="flow, ST, thrombus and air")
    parser.add_argument("-o", "--out", default="plots.png")
    a = parser.parse_args(arguments)
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    runs = [ostium.Recording(name) for name in a.recordings]
    with_patient = all("guide_mmHg" in run.signals.names for run in runs)
    of_patient = OF_THE_ARTERY if a.artery else OF_THE_PATIENT if a.patient else None
    if of_patient and not with_patient:
        parser.error("no blood flows in its vessel; expected a recording of a case")
    drawn = of_patient or [p for p in PLOTS if with_patient or p not in (pressure, lumen)]
    figure, grid = pyplot.subplots(len(drawn), len(runs), sharex="col", squeeze=False,
                                   figsize=(max(9, 6 * len(runs)), 1.9 * len(drawn)))
    for column, run in zip(grid.T, runs):
        for axes, plot in zip(column, drawn):
            plot(axes, run)
            axes.grid(alpha=0.3)
        column[-1].set_xlabel("time, s")
        if len(runs) > 1 and of_patient:
            column[0].set_title(run.setup["script"]["file"].removesuffix(".json"), fontsize=10)
    figure.tight_layout()
    figure.savefig(a.out, dpi=100)
    print(f"wrote {a.out}")


if __name__ == "__main__":
    main()
