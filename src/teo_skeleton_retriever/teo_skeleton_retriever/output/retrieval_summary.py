"""What a run over a bag came to."""

from __future__ import annotations

from collections import Counter

import numpy as np
from rich.table import Table

from teo_skeleton_retriever.bags.bag_images import BagImages
from teo_skeleton_retriever.image_retriever import Retrieved
from teo_skeleton_retriever.layouts.skeleton_3d import KeypointStatus


class RetrievalSummary:
    """Counts images, people and how their keypoints were found."""

    def __init__(self) -> None:
        self.images = 0
        """That were processed."""
        self._with_people = 0
        self._ids: set[int] = set()
        self._detector_times: list[float] = []
        self._own_times: list[float] = []
        self._statuses: dict[str, Counter[int]] = {part: Counter() for part in ("body", "hands", "face")}

    def add(self, result: Retrieved) -> None:
        """Count an image."""
        self.images += 1
        self._with_people += bool(result.skeletons)
        self._detector_times.append(result.detector_time)
        self._own_times.append(result.own_time)
        for skeleton in result.skeletons:
            self._ids.add(skeleton.track_id)
            if not skeleton.is_signer:
                continue
            self._statuses["body"].update(skeleton.body.status.tolist())
            self._statuses["hands"].update(skeleton.left_hand.status.tolist())
            self._statuses["hands"].update(skeleton.right_hand.status.tolist())
            self._statuses["face"].update(skeleton.face.status.tolist())

    def table(self, reader: BagImages) -> Table:
        """Show the counts, with what the reader left out."""
        table = Table(show_header=False)
        table.add_row("images", str(self.images))
        for reason, count in sorted(reader.dropped.items()):
            table.add_row(f"left out, {reason}", str(count))
        table.add_row("with people", str(self._with_people))
        table.add_row("people", str(len(self._ids)))
        for part, counts in self._statuses.items():
            table.add_row(f"signer's {part}", _shares(counts))
        if self.images:
            detector, own = np.median(self._detector_times) * 1e3, np.median(self._own_times) * 1e3
            table.add_row("time per image", f"detector {detector:.1f} ms, own {own:.1f} ms (medians)")
        return table


def _shares(counts: Counter[int]) -> str:
    total = sum(counts.values())
    if not total:
        return "-"
    order = (KeypointStatus.MEASURED, KeypointStatus.OPTIMISED, KeypointStatus.HELD, KeypointStatus.LOST)
    return ", ".join(f"{status.name.lower()} {100.0 * counts[status] / total:.0f} %" for status in order)
