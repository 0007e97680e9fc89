# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""A score as its file: YAML as people write it, a step a line."""

from __future__ import annotations

from typing import Any

import yaml

from teo_sign_authoring.notation.score_schema import Score

_WIDE = 10_000  # [characters] nothing is broken into lines


def score_text(score: Score) -> str:
    """The text of a compiled score, a lexical one without forms, which `read_score` reads."""
    content = score.model_dump(exclude_none=True, exclude_defaults=True)
    lines = [f"{name}: {_flow(content[name])}" for name in ("gloss", "standing", "source", "hands")]
    lines += [f"{name}: {_flow(content[name])}" for name in ("face", "notes") if content.get(name)]
    lines.append("steps:")
    for step in content["steps"]:
        fields = {name: step[name] for name in _ORDER if name in step}
        if not fields:
            continue
        for index, (name, value) in enumerate(fields.items()):
            lines.append(f"  {'- ' if index == 0 else '  '}{name}: {_flow(value)}")
    return "\n".join(lines) + "\n"


_ORDER = ("time", "left", "right", "arc", "circle", "wiggle", "head", "hold")


def _flow(value: Any) -> str:
    text: str = yaml.safe_dump(
        value, default_flow_style=True, allow_unicode=True, width=_WIDE, sort_keys=False
    )
    return text.removesuffix("\n").removesuffix("\n...").strip()
