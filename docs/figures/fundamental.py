#!/usr/bin/env python3
"""Draws docs/figures/fundamental.png from the program's own data: the fundamental case as in the paper's Fig. 4.

    cargo run --release -- solve fundamental --fidelity fine --out results
    python3 docs/figures/fundamental.py results docs/figures/fundamental.png     (needs matplotlib)
"""

import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Okabe and Ito's colours, told apart by colour-blind readers.
CONTACT, FILM, STATOR, ROTOR = "#d55e00", "#0072b2", "#8c8c8c", "#e2e2e2"
WIDTH_MM = 0.3  # radial contact width: line load / width = pressure


def read(folder):
    """Nodes of the time step whose crest is on the middle tooth, by tooth; wavelength [mm]; summary."""
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "fields.csv", newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    teeth = int(max(row["tooth"] for row in rows)) + 1
    pitch = 1e3 * sum(row["x_m"] for row in rows if row["tooth"] == 1) / sum(1 for row in rows if row["tooth"] == 1)
    wanted = 1 - (teeth // 2) / teeth  # the wave travels towards -x: the crest is at x = -phase * wavelength
    phase = min({row["phase"] for row in rows}, key=lambda p: abs(p - wanted))
    lines = [[row for row in rows if row["phase"] == phase and row["tooth"] == tooth] for tooth in range(teeth)]
    return lines, pitch, summary


def main():
    folder, target = Path(sys.argv[1]), Path(sys.argv[2])
    lines, pitch, summary = read(folder)
    wavelength = pitch * len(lines)
    plt.rcParams.update({"font.family": "DejaVu Sans", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False})
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(10, 6.2), sharex=True, height_ratios=[1.15, 1], gridspec_kw={"hspace": 0.16}
    )

    x = [[1e3 * row["x_m"] for row in line] for line in lines]
    stator = [[1e-3 * row["stator_nm"] for row in line] for line in lines]
    rotor = [[1e-3 * row["rotor_nm"] for row in line] for line in lines]
    floor, ceiling = -1.75, 2.6

    # The rotor's underside is known at the teeth; over a groove nothing acts on it, and the ends are joined. It repeats.
    flat_x = [v - wavelength for v in x[-1]] + sum(x, []) + [v + wavelength for v in x[0]]
    flat_rotor = rotor[-1] + sum(rotor, []) + rotor[0]
    top.fill_between(flat_x, flat_rotor, ceiling, color=ROTOR, lw=0)
    top.plot(flat_x, flat_rotor, color="#444444", lw=1.4)
    for tooth_x, tooth_stator, tooth_rotor, line in zip(x, stator, rotor, lines):
        top.fill_between(tooth_x, floor, tooth_stator, color=STATOR, lw=0)
        top.fill_between(tooth_x, tooth_stator, tooth_rotor, color="#56b4e9", alpha=0.45, lw=0)
        top.plot(tooth_x, tooth_stator, color="#222222", lw=1.4)
        touching = [row["contact_n_per_m"] > 0 for row in line]
        for i in range(len(line) - 1):
            if touching[i] and touching[i + 1]:
                top.plot(tooth_x[i : i + 2], tooth_stator[i : i + 2], color=CONTACT, lw=3, solid_capstyle="butt")
    top.set_ylim(floor, ceiling)
    top.set_ylabel("normal displacement [µm]")
    top.text(0.5 * pitch * (len(lines) - 1), 2.25, "rotor", ha="center", va="center", fontsize=12)
    for tooth in range(len(lines)):
        top.text(tooth * pitch, floor + 0.16, "tooth" if tooth in (0, len(lines) - 1) else "", ha="center", color="white")
    top.annotate("wave", xy=(0.02, 1.95), xytext=(3.1, 1.95), va="center", arrowprops={"arrowstyle": "->", "lw": 1.3})
    top.annotate(
        "rotor is driven", xy=(wavelength - pitch + 0.3, 1.95), xytext=(wavelength - pitch - 6.1, 1.95), va="center",
        arrowprops={"arrowstyle": "->", "lw": 1.3},
    )
    middle = len(lines) // 2
    for tooth in (middle - 1, middle, middle + 1):
        at = len(x[tooth]) // 2
        top.annotate(
            "in contact" if tooth == middle else "", xy=(x[tooth][at], stator[tooth][at]), xytext=(middle * pitch, 1.72),
            ha="center", va="center", color="#222222",
            arrowprops={"arrowstyle": "-", "color": CONTACT, "lw": 1, "shrinkA": 9, "shrinkB": 2},
        )
    for tooth in (0, len(lines) - 1):
        at = len(x[tooth]) // 2
        top.text(tooth * pitch, 0.5 * (stator[tooth][at] + rotor[tooth][at]), "air film", ha="center", va="center",
                 color="#003f66")

    # N/m over mm is kPa.
    for tooth_x, line in zip(x, lines):
        contact = [row["contact_n_per_m"] / WIDTH_MM for row in line]
        film = [row["film_n_per_m"] / WIDTH_MM for row in line]
        if max(contact) > 0:
            bottom.fill_between(tooth_x, contact, color=CONTACT, alpha=0.25, lw=0)
            bottom.plot(tooth_x, contact, color=CONTACT, lw=1.4)
        bottom.fill_between(tooth_x, film, color=FILM, alpha=0.35, lw=0)
        bottom.plot(tooth_x, film, color=FILM, lw=1.6)
    bottom.axhline(0, color="#222222", lw=0.8)
    top_pressure = max(row["contact_n_per_m"] / WIDTH_MM for line in lines for row in line)
    bottom.set_ylim(-200, 1.12 * top_pressure)
    bottom.set_ylabel("pressure on the tooth [kPa]")
    bottom.set_xlabel("along the ring, one wavelength [mm]")
    bottom.set_xlim(-0.5 * pitch, wavelength - 0.5 * pitch)
    share = summary["alpha"]
    bottom.text(
        0.012, 0.95, f"contact carries {100 * (1 - share):.1f} % of the load (cycle mean)", color=CONTACT,
        transform=bottom.transAxes, va="top", fontsize=11,
    )
    bottom.text(
        0.012, 0.84, f"air film carries {100 * share:.1f} %", color=FILM, transform=bottom.transAxes, va="top", fontsize=11
    )
    note = "mean across the width of 0.3 mm\nfilm: above ambient pressure\nfilm thickness: the gap drawn + 200 nm of roughness"
    bottom.text(0.995, 0.95, note, color="#555555", transform=bottom.transAxes, va="top", ha="right", fontsize=9)

    figure.subplots_adjust(left=0.075, right=0.985, top=0.93, bottom=0.085)
    box = top.get_window_extent()
    exaggeration = 1e3 * (box.height / (ceiling - floor)) / (box.width / wavelength)
    top.set_title(
        f"Fundamental case, one instant (vertical scale of displacements exaggerated {round(exaggeration, -2):.0f}×)",
        loc="left", fontsize=11.5,
    )
    figure.align_ylabels()
    figure.savefig(target, dpi=150)


if __name__ == "__main__":
    main()
