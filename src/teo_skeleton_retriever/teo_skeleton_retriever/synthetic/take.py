"""A take: one person, in one scene, plays one script before one sensor."""

from __future__ import annotations

from collections.abc import Iterator

from teo_skeleton_retriever.synthetic.truth import SyntheticFrame


def render_take(
    *,
    script: str = "signing",
    body: str = "woman_average",
    scene: str = "office",
    sensor: str = "d435",
    distance: float = 1.5,
    camera_height: float = 1.2,
    camera_pitch: float = 0.0,
    rate: float = 30.0,
    seed: int = 0,
) -> Iterator[SyntheticFrame]:
    """Render a take, frame by frame.

    Args:
        script: what the person does.
        body: who.
        scene: what is around.
        sensor: what measures.
        distance: from the camera to the person, along the floor [m].
        camera_height: above the floor [m].
        camera_pitch: of the camera downwards [rad].
        rate: frames per second [Hz].
        seed: of everything that is random; the same gives the same frames.

    Yields:
        The frames, in order.
    """
    del script, body, scene, sensor, distance, camera_height, camera_pitch, rate, seed
    return iter(())
