"""Takes that the retriever's constants are calibrated on: other bodies and motions than it is tested on."""

from __future__ import annotations

from accuracy_takes import TakeSettings

_MOTIONS = {
    "signing": (0.4, 2.2, 4.0, 6.2),
    "two_hands": (0.6, 2.0, 3.4),
    "hello": (0.3, 2.0),
    "side_step": (0.6, 2.4),
}
_BODIES = ("woman_average", "man_average", "man_heavy")
_SCENES = ("office", "studio", "living_room", "near_wall")
_DISTANCES = (1.2, 1.5, 1.8, 2.1)
_HEIGHTS = (1.1, 1.4, 1.6)  # [m]

TUNING_TAKES: tuple[TakeSettings, ...] = tuple(
    TakeSettings(
        script=script,
        body=_BODIES[(i + k) % 3],
        scene=_SCENES[(i + k) % 4],
        distance=_DISTANCES[(i + 3 * k) % 4],
        camera_height=_HEIGHTS[(i + 2 * k) % 3],
        start=start,
        seed=10 * i + k,
    )
    for i, (script, starts) in enumerate(_MOTIONS.items())
    for k, start in enumerate(starts)
)
