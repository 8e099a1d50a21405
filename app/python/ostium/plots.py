"""The five plots that people make first of a recording: python3 -m ostium.plots out/run.h5 -o plots.png

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


PLOTS = (depth, hands, walls, pressure, lumen)


def tools_of(run):
    """Names of the run's tools, in its order."""
    return [name.removesuffix(".inserted_mm") for name in run.signals.names if name.endswith(".inserted_mm")]


def smoothed(signal, samples=10):
    return np.convolve(signal, np.ones(samples) / samples, mode="same")


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="python3 -m ostium.plots", description=__doc__.split(":")[0] + ".",
                                     epilog="example: python3 -m ostium.plots out/run.h5 -o plots.png")
    parser.add_argument("recording")
    parser.add_argument("-o", "--out", default="plots.png")
    a = parser.parse_args(arguments)
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    run = ostium.Recording(a.recording)
    drawn = [plot for plot in PLOTS if plot not in (pressure, lumen) or "guide_mmHg" in run.signals.names]
    figure, rows = pyplot.subplots(len(drawn), 1, sharex=True, figsize=(9, 1.9 * len(drawn)))
    for axes, plot in zip(np.atleast_1d(rows), drawn):
        plot(axes, run)
        axes.grid(alpha=0.3)
    np.atleast_1d(rows)[-1].set_xlabel("time, s")
    figure.tight_layout()
    figure.savefig(a.out, dpi=100)
    print(f"wrote {a.out}")


if __name__ == "__main__":
    main()
