"""Tables of the figures, and their places in the documents."""

import json
import os

import paths


def machine():
    with open("/proc/cpuinfo") as file:
        names = [line.split(":")[1].strip() for line in file if line.startswith("model name")]
    return f"{names[0] if names else 'unknown processor'}, {os.cpu_count()} cores"


def _seconds(value):
    return f"{value:.4f}" if value < 0.01 else f"{value:.3f}" if value < 1 else f"{value:.2f}" if value < 10 else f"{value:.1f}"


SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def _error(row, key):
    if key not in row:
        return ""
    value, unit = row[key], {"m": " m", "relative": ""}.get(row["unit"], f" {row['unit']}")
    if value == 0:
        return f"0{unit}"
    if value >= 0.001:
        return f"{value:.2g}{unit}"
    digits, power = f"{value:.0e}".split("e")
    return f"{digits} · 10{str(int(power)).translate(SUPERSCRIPT)}{unit}"


def _tool(row):
    if row["tool"] == "slopegen":
        return "**slopegen**"
    name, comma, rest = row["tool"].partition(",")
    return f"{name} {row['version']}".strip() + comma + rest


def _memory(row):
    return f"{'< ' if row.get('below') else ''}{row['mb']:.0f}"


def _ratio(row):
    return f"{row['ratio']:.2g}" if row["ratio"] < 10 else f"{row['ratio']:.0f}"


def whole(result):
    lines = [
        "| job | tool | CPU s | wall s | peak MB | CPU / slopegen's | RMS error | max error | |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    title = None
    for row in result["rows"]:
        job, title = ("" if row["title"] == title else row["title"]), row["title"]
        if "skipped" in row:
            lines.append(f"| {job} | {_tool(row)} | | | | | | | **not measured: {row['skipped'].replace('|', '/')}** |")
            continue
        cells = [job, _tool(row), _seconds(row["cpu"]), _seconds(row["wall"]), _memory(row), _ratio(row)]
        lines.append(f"| {' | '.join([*cells, _error(row, 'rms'), _error(row, 'max'), row['said']])} |")
    return _setting(result) + "\n\n" + "\n".join(lines) + "\n"


def _setting(result):
    load = "{:.1f} to {:.1f}".format(*sorted(result["load"]))
    return f"*{result['machine']}; load {load}; median of {result['repeats']} runs; {result['seconds'] / 60:.0f} minutes*"


def short(result):
    lines = ["| job | tool | CPU s | max error | |", "|---|---|---|---|---|"]
    title = None
    for row in result["rows"]:
        if not row["readme"] or "skipped" in row:
            continue
        job, title = ("" if row["title"] == title else row["title"]), row["title"]
        lines.append(f"| {job} | {_tool(row)} | {_seconds(row['cpu'])} | {_error(row, 'max')} | {row['said']} |")
    return "\n".join(lines) + f"\n\n{_setting(result)}\n"


def commands(result):
    return "```\n" + "\n".join(row["command"] for row in result["rows"] if "command" in row) + "\n```\n"


def _between(path, mark, text):
    path = os.path.join(paths.ROOT, path)
    with open(path) as file:
        before, rest = file.read().split(f"<!-- {mark} -->\n", 1)
        after = rest.split(f"<!-- /{mark} -->", 1)[1]
    with open(path, "w") as file:
        file.write(f"{before}<!-- {mark} -->\n{text}<!-- /{mark} -->{after}")


def write_docs():
    if not os.path.exists(paths.FULL):
        return "there was no full run yet: tests/peers/run"
    with open(paths.FULL) as file:
        result = json.load(file)
    _between("README.md", "peers", short(result))
    _between("docs/peers.md", "peers", whole(result))
    _between("docs/peers.md", "commands", commands(result))
    print("README.md and docs/peers.md have the figures of the last full run")
