"""The report of a reader's own body: its title in words, the blocks of its parts, and what it leaves out.

`templates/report/your_body.md` has the prose; it sees the values that `values_of` returns, and decides nothing.
"""

import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from hashlib import sha256
from typing import Any

from atlas.arithmetic.uncertainty import concise
from atlas.bodies.formula_shapes import SHAPES
from atlas.bodies.laboratory import Disturbance, Spinning, disturbances
from atlas.book import toml
from atlas.book.bibliography import software
from atlas.book.blocks.explorer import sliders_of
from atlas.book.card import ENTRIES, ONE_PERIOD, card, centre_of, has_card, object_of
from atlas.book.digits import Number, plain, spaced
from atlas.book.elsewhere import neighbours, reproduced
from atlas.book.markdown import fenced
from atlas.book.measurement import measurement_of
from atlas.book.parts import (
    ReportRequest,
    case_of,
    closed_of,
    deviations_of,
    figures_of,
    headed,
    other_families,
    records_of,
    setting_of,
    table_of,
    templated,
    too_slow,
)
from atlas.book.templates import versions
from atlas.book.verdict import has_mean_rates, is_still, place_of, shape_words, turns_over, verdict
from atlas.places import folder

NAME = "your_body"
"""Name of the report, before the digest of its inputs."""
PICTURE = f"{NAME}.py"
"""File of this recipe beside the reports, one for all."""
OPTION = "\n  "
"""What precedes an option in a file of inputs, so that each has a line of its own."""
LEAST = 1e-4
"""Amplitude over the whole below which a line of a spectrum is not counted, as in its figure."""
PART = {"quadric": "body", "hyperbola": "body", "frequencies": "maps", "stability": "maps", "motion_map": "maps",
        "energy_momentum": "maps"}  # fmt: skip
"""Part of a report to which a figure belongs, by recipe; all others are of the motion."""


def body_named(request: ReportRequest, card: Mapping[str, Any]) -> str:
    """Return the body in words, with its size or its moments as they were typed."""
    options = request.options
    if "shape" in options:
        shape = options["shape"][0].replace("-", " ").replace("_", " ")
        for name in ("radius", "length", "equatorial", "polar"):
            if name in options:
                size = options[name][0]
                length = " cm" if options.get("units") == ("gaussian",) else " m"
                unit = length if re.fullmatch(r"[\d.e+-]+", size) and request.time == "s" else ""
                return f"{shape} of {name}{' radius' if name in {'equatorial', 'polar'} else ''} {spaced(size)}{unit}"
        return shape
    if card["ratio"]["value"] is not None:
        return f"body with I = {card['ratio']['value']:.8g}"
    return f"body with the moments {', '.join(map(plain, request.values['inertia']))}"


def title_of(request: ReportRequest, card: Mapping[str, Any], says: str) -> str:
    """Return the title of a report: the body, the time of one turn, and the verdict `says`; `card` has the numbers.

    Of an object without a card it is the object's description.
    """
    if not has_card(request.family):
        return object_of(request).says
    turn, body = card["turn"], body_named(request, card)
    subject = f"{'An' if body[0] in 'aeiou' else 'A'} {body}"
    if turn["value"] is None:
        return f"{subject}: {says}"
    mean = " on average" * has_mean_rates(object_of(request))
    return f"{subject} turns about {centre_of(request)} once in {_lasting(turn)}{mean}; {says}"


def sign_of(request: ReportRequest) -> str:
    """Return a sentence on the direction of B' if charge or charge-to-mass ratio is negative, else ""."""
    record = {**(request.body or {}), **(request.field or {})}
    if not any(Fraction(record.get(name) or 0) < 0 for name in ("charge", "charge_to_mass")):
        return ""
    return "The charge is negative: B\N{PRIME} points against B, and arrows named B in the figures show B\N{PRIME}."


def shape_of(request: ReportRequest) -> dict[str, Any] | None:
    """Return parameters of the body's picture: {"is_ball": True}, or {"radius": m, "height": m}.

    The first is for a sphere or spherical shell. A shape without a radius or height, such as a rod or a ring, has 0 for
    it; a rod's length is its height. None for a spheroid, and without a shape.
    """
    body = request.body or {}
    if "shape" not in body or body["shape"] == "spheroid":
        return None
    if "sphere" in body["shape"] or "spherical" in body["shape"]:
        return {"is_ball": True}
    return {"radius": body.get("radius", 0.0), "height": body.get("height", body.get("length", 0.0))}


def maps_of(request: ReportRequest) -> dict[str, dict[str, Any]]:
    """Return the parameters of the figures on all motions of the body, by recipe; {} without a body or field.

    Each value is a dict of the recipe's parameters by name, empty where the report's body and field suffice.
    """
    if not request.body:
        return {}
    case = case_of(request)
    b = math.hypot(*case.components)
    spin = request.values.get("omega", (0.0, 0.0, 0.0))[2]
    if not b:
        return {}
    return {
        "quadric": {}, "hyperbola": {}, "frequencies": {}, "stability": {},
        "motion_map": {"ratios": [case.ratio], "field": list(case.components), "cells": 60},
        "energy_momentum": {"ratios": [case.ratio], "b": [b], "M3": case.ratio * spin or 0.25 * b},
    }  # fmt: skip


def evaluated(request: ReportRequest) -> dict[str, Any]:
    """Return the inputs as evaluated, a dict for JSON: equal for two ways to type one body.

    Its keys are family, time, values, and where there are such body, field, sigma and parts.
    """
    records = {"body": request.body, "field": request.field}
    bare = {name: {k: v for k, v in record.items() if k != "title"} for name, record in records.items() if record}
    sigma = {"sigma": {key: float(f"{x:.6g}") for key, x in request.sigma.items()}} if request.sigma else {}
    parts = {"parts": list(request.parts)} if request.only else {}
    return {
        "family": request.family.name, "time": request.time, **bare, "values": dict(request.values), **sigma, **parts,
    }  # fmt: skip


def digest_of(request: ReportRequest) -> str:
    """Return eight hexadecimal digits of the SHA-256 of the evaluated inputs."""
    return sha256(json.dumps(evaluated(request), sort_keys=True).encode()).hexdigest()[:8]


def name_of(request: ReportRequest) -> str:
    """Return the report's name: the given name, or "your_body", then "-" and the digest of the inputs."""
    return f"{request.file_name or NAME}-{digest_of(request)}"


def inputs_of(request: ReportRequest) -> str:
    """Return the text of NAME.inputs.toml: inputs as typed and as evaluated, defaults, digest, versions; no clock."""
    omitted = [
        p.name
        for p in request.family.parameters
        if p.option and p.omitted is not None and p.name in request.values and p.name not in request.options
    ]
    option_lines = "".join(f"{OPTION if word.startswith('--') else ' '}{toml.source(word)}," for word in request.words)
    content = {"defaults": omitted, "digest": digest_of(request),
               "evaluated": evaluated(request), "versions": versions()}  # fmt: skip
    return f"# {request.command}\ntyped = [{option_lines.removeprefix(' ')}\n]\n" + "".join(toml.lines(content))


def works() -> str:
    """Return BibTeX text for the paper, where the references have it, and for this version of the atlas."""
    entries = (folder("reports") / "references.bib").read_text(encoding="utf-8")
    paper = re.search(r"@article\{deriglazov2024,.*?\n\}\n", entries, re.DOTALL)
    return f"{paper[0] if paper else ''}\n{software()}"


def files_of(request: ReportRequest) -> dict[str, str]:
    """Return the files of a report, texts by name: its Markdown, card, inputs and BibTeX, the recipe of its picture.

    The last only where the report shows the body's picture.

    Raises
    ------
    AtlasError
        Where there is no such object.
    """
    name, numbers = name_of(request), card(request)
    values = template_values(request, numbers)
    head = {"title": values["title"], "front_matter": False} | records_of(request)
    content = templated(name, "your_body.md", head, values, request.command)
    record = numbers | {key: values[key] for key in ("title", "verdict", "outweighed_by")}
    made_files = {
        f"{name}.md": content,
        f"{name}.card.json": json.dumps(record, indent=1, ensure_ascii=False) + "\n",
        f"{name}.inputs.toml": inputs_of(request),
        f"{name}.bib": works(),
    }
    if PICTURE in content:
        recipe = (folder("templates") / "report" / "body.py.txt").read_text(encoding="utf-8")
        made_files[PICTURE] = headed(NAME, recipe, f"atlas report {NAME}")
    return made_files


def template_values(request: ReportRequest, card: Mapping[str, Any]) -> dict[str, Any]:
    """Return the values that the report's template sees, by name: words, rows of the card, and fenced blocks.

    `card` is the card of `request`.
    """
    family, shape, item, ratio = request.family, shape_of(request), object_of(request), card["ratio"]["value"]
    motion, effects, left_out = item.kernels(), list(disturbances_of(request, card)), list[str]()
    figures, closed, measured = figures_by_part(request, left_out), list[str](), list[str]()
    if shape and "card" in request.parts:
        figures["card"] = [fenced({"kind": "figure", "recipe": PICTURE, "id": "body", "parameters": shape})]
    if "motion" in request.parts:
        closed = [*map(fenced, closed_of(request, left_out))] if not is_still(item) else []
        measured = [*map(fenced, measurement_of(request, card, left_out))]
    says = verdict(item)
    left_out += [
        *_reasons(card),
        *([] if is_still(item) else too_slow(motion, request.time)),
        *_absent(request, shape, bool(effects)),
    ]
    surfaces = other_families(family) if maps_of(request) else []
    tables = [table_of(request, "properties", surface.name, {"given": False}) for surface in surfaces]
    return {
        "name": name_of(request), "title": request.title or title_of(request, card, says), "verdict": says,
        "turnover": _lasting(card["nutation"]) if turns_over(item) else "",
        "place": place_of(family, motion), "sign": sign_of(request), "command": request.command, "note": request.note,
        "parts": list(request.parts), "family": family.name, "follows": bool(family.sampled), "card": [*_rows(card)],
        "outweighed": outweighed(effects), "outweighed_by": [effect.says for effect in effects if effect.outweighs],
        "disturbances": [*map(_row_of, effects)], "ratio": ratio, "stands": "" if ratio is None else shape_words(ratio),
        "figures": figures, "left_out": left_out, "symmetric": bool(request.body), "others": [*map(fenced, tables)],
        "deviations": "".join(map(fenced, deviations_of(request))), "closed": "".join(closed + measured),
        "explorer": "".join(map(fenced, explorer_of(request, left_out) if "card" in request.parts else ())),
        "properties": fenced(table_of(request, "properties", family.name, request.exact_values)),
        "setting": "".join(map(fenced, setting_of(request))),
        "again": reproduced(request, motion) if "elsewhere" in request.parts else None,
        "neighbours": [[words, f"`{neighbour.command}`"] for words, neighbour in neighbours(request)],
    }  # fmt: skip


def _lasting(entry: Mapping[str, Any]) -> str:
    """Return a time of the card, one of its records, in a sentence, "132.7 units of time" or "2.5(1) s".

    Else "no time".
    """
    if entry["value"] is None:
        return "no time"
    time = concise(entry["value"], entry["sigma"]) if entry["sigma"] else f"{entry['value']:.4g}"
    return f"{time} {entry['unit'].replace('time', 'units of time')}"


def figures_by_part(request: ReportRequest, left_out: list[str]) -> dict[str, list[str]]:
    """Return lists of fenced figure blocks by part: "card", "body", "motion" and "maps", all four.

    The list of a part that the report does not have is empty. Sentences on why some figures are missing are added to
    `left_out`.
    """
    maps = maps_of(request)
    candidates = maps | {name: dict[str, Any]() for name in request.family.figures if maps or name not in PART}
    if "asymmetric_motion" in candidates and turns_over(object_of(request)):
        candidates["asymmetric_motion"] = {"turns": 12.0}  # as many as its panel of Omega has at most
    asked_for = {name: values for name, values in candidates.items() if PART.get(name, "motion") in request.parts}
    for name, reason in without_change(request) if "motion" in request.parts else ():
        if asked_for.pop(name, None) is not None:
            left_out += [reason] * (reason not in left_out)
    figures: dict[str, list[str]] = {"card": [], "body": [], "motion": [], "maps": []}
    for block in figures_of(request, asked_for, left_out):
        figures[PART.get(block["recipe"], "motion")].append(fenced(block))
    return figures


def without_change(request: ReportRequest) -> Iterator[tuple[str, str]]:
    """Yield (recipe, reason) of each figure on which nothing of the request's motion would change."""
    item = object_of(request)
    motion = item.kernels()
    if is_still(item):
        reason = "Trace, spectrum and course in time: axis and angular velocity are constant."
        yield from ((name, reason) for name in request.family.figures if name not in PART)
        return
    nods = str(motion.kind).startswith(("nutation", "separatrix")) if hasattr(motion, "kind") else False
    if "pseudo_oscillator" in request.family.figures and not nods and len(set(motion.turning_points)) == 1:
        yield "pseudo_oscillator", "The potential of $\\Omega_3$: this component is constant."
    if "spectrum" in request.family.figures:
        lines = [motion.spectrum(name, LEAST).frequencies for name in ("axis", "angular_velocity")]
        axis, spin = (sorted({abs(float(f)) for f in frequencies} - {0.0}) for frequencies in lines)
        if len(axis) == 1 and not spin:
            unit = "s" if request.time == "1/s" else request.time
            says = f"the axis has one line, at {axis[0]:.6g} 1/{unit}, and $\\mathbf\\Omega$ has none"
            yield "spectrum", f"The spectrum: down to {LEAST:g} of the whole {says}."


def explorer_of(request: ReportRequest, left_out: list[str]) -> Iterator[dict[str, Any]]:
    """Yield the block of an explorer of a symmetric body in a field, from its start.

    Without such a body, field and start, and for values beyond the sliders, nothing is yielded, and the reason is
    added to `left_out`. In units of time other than "time" rates are in units of |B'|.
    """
    if not (request.body and request.family.sampled and any(case_of(request).components)):
        left_out.append("An explorer: its sliders are those of a symmetric body in a field, with a start.")
        return
    case, values = case_of(request), request.values
    unit = math.hypot(*case.components) if request.time != "time" else 1.0
    B2, B3 = (x / unit for x in case.components)
    names = ("omega1", "omega2", "omega3") if "omega" in values else ("omega2",)
    rates = values["omega"] if "omega" in values else (values["omega2"],)
    start = {"I": case.ratio} | {name: x / unit for name, x in zip(names, rates, strict=True)}
    sliders, placed = sliders_of(B2, B3), start | {"angle": math.degrees(math.atan2(B3, B2))}
    if any(not sliders[name].low <= x <= sliders[name].high for name, x in placed.items()):
        left_out.append("An explorer: body, field or start lie beyond its sliders.")
        return
    text = "The body, the angle of the field and the start can be changed here."
    scaled = " Rates are in units of $|\\mathbf{B}'|$." * (unit != 1.0)
    yield {"kind": "explorer", "text": text + scaled, "panels": ["body", "plane"], "at": [B2, B3],
           "sliders": [*dict.fromkeys(("I", "angle", *names, "omega3"))], "start": start}  # fmt: skip


def _reasons(card: Mapping[str, Mapping[str, Any]]) -> Iterator[str]:
    """Yield a sentence for each reason why numbers are missing on the `card`, with their names."""
    reasons = dict[str, list[str]]()
    for entry in card.values():
        if entry["reason"] not in {None, ONE_PERIOD}:
            reasons.setdefault(entry["reason"], []).append(entry["says"])
    for reason, names in reasons.items():
        words = "the card" if len(names) == len(ENTRIES) else ", ".join(names)
        yield f"{words[:1].upper()}{words[1:]}: {reason[:1].lower()}{reason[1:]}."  # but B stays B


def _rows(card: Mapping[str, Mapping[str, Any]]) -> Iterator[list[str]]:
    """Yield six texts for each number of the `card`: words, letter, value and error, unit, digits, equation."""
    for entry in card.values():
        if entry["value"] is None:
            continue
        value, unknown_error = Number(entry["digits"]).words(), entry["reason"]
        if entry["sigma"] or unknown_error:
            value = Number(concise(entry["value"], math.inf if unknown_error else entry["sigma"])).words()
        proven = str(entry["proven_digits"] or "") if not entry["sigma"] else ""
        equation = f"@{entry['equation']}" if entry["equation"] else ""
        yield [entry["says"], entry["letter"], value, entry["unit"] or "", proven, equation]


def disturbances_of(request: ReportRequest, card: Mapping[str, Mapping[str, Any]]) -> Iterator[Disturbance]:
    """Yield a `Disturbance` for each neglected effect, such as gravity; `card` is the card of `request`.

    Nothing is yielded without a shape, a mass or density, and a field B in SI.
    """
    body = request.body or {}
    if "shape" not in body or not {"mass", "density"} & request.options.keys() or request.magnetic is None:
        return
    case, (mu, strength) = case_of(request), request.magnetic
    turn = card["turn"]["value"]
    yield from disturbances(Spinning(
        body["shape"], {name: body[name] for name in SHAPES[body["shape"]][0] if name != "mass"}, body["mass"],
        mu, (float(case.body.I2), float(case.body.I3)), strength,
        math.hypot(*request.values.get("omega", (request.values.get("omega2", 0.0),))),
        2 * math.pi / turn if turn else card["larmor"]["value"] or 0.0,
    ))  # fmt: skip


def outweighed(effects: Sequence[Disturbance]) -> str:
    """Return a sentence on the neglected effects that outweigh the computed motion; "" if there are none.

    `effects` are all of them.
    """
    names = [effect.says.partition(",")[0] for effect in effects if effect.outweighs]
    return f"Effects larger than those shown: {', '.join(names)}." if names else ""


def _row_of(effect: Disturbance) -> list[str]:
    """Return a neglected effect as six texts: words, letter, number, unit, formula, verdict."""
    return [effect.says, effect.letter, Number(f"{effect.value:.2e}").words(),
            effect.unit, effect.formula, effect.verdict]  # fmt: skip


def _absent(request: ReportRequest, shape: Mapping[str, Any] | None, is_told: bool) -> Iterator[str]:
    """Yield sentences on parts that this report lacks, with the reason of each.

    `shape` are the parameters of the body's picture or None; `is_told` says that neglected effects are told.
    """
    is_top, parts = request.family.takes("coupling"), request.parts
    if not shape and not is_top and "card" in parts:
        yield "A picture of the body: no cylinder, ring, disk, rod or ball was given as its shape."
    if not request.deviations and "motion" in parts:
        yield "Errors of the numbers: the inputs have none; type `1.20(5)um` for one."
    if not maps_of(request) and {"body", "maps"} & {*parts}:
        yield "Quadric, hyperbola and the map of all motions: they are those of a symmetric body in a field."
    if not is_told:
        remedy = "; in numbers for a shape with its mass or density and a field `--magnetic` in SI" * bool(request.body)
        yield f"{'D' if is_top else 'Gravity, d'}rag, radiation, induced magnetism, eddy currents{remedy}."
