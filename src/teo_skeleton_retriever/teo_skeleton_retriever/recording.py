# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""Skeletons of a whole recording, without ROS running: what `retrieve` and other packages call."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from std_msgs.msg import Header

from teo_skeleton_retriever.bags.bag_images import BagImage, BagImages, Topics, choose_topics
from teo_skeleton_retriever.bags.bag_reader import Bag
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP
from teo_skeleton_retriever.detectors import make_detector
from teo_skeleton_retriever.detectors.detector import left_out_sentence
from teo_skeleton_retriever.errors import RetrieverError
from teo_skeleton_retriever.image_retriever import ImageRetriever, Retrieved, nobody_in_space
from teo_skeleton_retriever.output.messages import skeleton_array
from teo_skeleton_retriever.output.skeleton_bag import skeleton_bag
from teo_skeleton_retriever.retriever import Retriever


@dataclass(frozen=True, kw_only=True)
class RetrievalReport:
    """What the retrieval of a recording came to.

    Attributes:
        recording: Path of the bag.
        topics: That were read.
        images: Number of images that were processed.
        images_with_people: Number of these in which somebody was found.
        people: Number of different people.
        statuses: Number of the signer's keypoints by `KeypointStatus`, for "body", "hands" and "face".
        detector_time: Median time of the detector for an image [s]; NaN without images.
        own_time: Median time of the rest for an image [s]; NaN without images.
        left_out: Number of colour images that could not be used, by reason code.
        reasons: A sentence for the first image of a reason code. Where only few images are without a depth
            image, as at the ends of recordings, these are in `left_out` alone.
        nobody: Why nobody is in space although the detector saw people; empty if somebody is, or nobody was.
        people_left_out: How many more people the detector saw at once than it followed, at most.
        damage: What is wrong with the bag, of which the rest was used; empty if nothing is.
    """

    recording: Path
    topics: Topics
    images: int
    images_with_people: int
    people: int
    statuses: Mapping[str, Mapping[int, int]]
    detector_time: float
    own_time: float
    left_out: Mapping[str, int]
    reasons: Mapping[str, str]
    nobody: str
    people_left_out: int
    damage: str

    @property
    def complaints(self) -> tuple[str, ...]:
        """What could not be used, a sentence each; empty if all went well."""
        said = [
            f"{self.left_out[reason]} images left out, {reason}: {sentence}"
            for reason, sentence in self.reasons.items()
        ]
        if self.damage:
            said.append(f"{self.recording}: {self.damage}")
        if self.nobody:
            said.append(self.nobody)
        if told := left_out_sentence(self.people_left_out):
            said.append(told)
        if not self.images:
            counts = ", ".join(f"{count} left out, {reason}" for reason, count in self.left_out.items())
            said.append(f"no image of {self.topics.color} could be used: {counts or 'there is none'}")
        return tuple(said)


def retrieve_recording(
    recording: Path,
    images: ImageRetriever | None = None,
    *,
    out: Path | None = None,
    slop: float = DEFAULT_SLOP,
    rectified: bool = False,
    color_topic: str = "",
    depth_topic: str = "",
    camera_info_topic: str = "",
    on_progress: Callable[[int, int], None] | None = None,
    on_image: Callable[[BagImage, Retrieved], None] | None = None,
) -> RetrievalReport:
    """Find the people in the images of a recording, in space.

    Every image is processed, however long it takes. An image that the detector or the retriever refuses is
    left out and counted; of a bag that was cut off, what is before the cut is used. `complaints` of the
    result says so.

    Args:
        recording: ROS 2 bag (folder, .mcap, .db3) or ROS 1 bag (.bag).
        images: Detector and retriever; the caller closes it. None makes those of the default, MediaPipe.
        out: MCAP file to write with the topic `/skeletons`, replaced if it exists; None writes none. It
            appears whole or not at all.
        slop: Greatest difference between the stamps of colour and depth [s].
        rectified: Whether the images were rectified: then P of camera_info holds.
        color_topic: Topic of the colour images; empty finds it where only one can be meant.
        depth_topic: Likewise, of the depth images.
        camera_info_topic: Likewise, of the camera.
        on_progress: Called after each message, with the number of messages read and that of all.
        on_image: Called with each image that was processed and the people in it.

    Raises:
        TopicError: A topic is not found or ambiguous: "no_depth", "ambiguous_color", ...
        RetrieverError: There is no bag, nothing in it can be read, or there is no such topic; MediaPipe
            cannot be used; `out` has another suffix or no folder.
        OSError: `out` cannot be written.
    """
    with ExitStack() as stack:
        bag = Bag(recording)
        topics = choose_topics(bag, color=color_topic, depth=depth_topic, camera_info=camera_info_topic)
        reader = BagImages(bag, topics, slop=round(slop * 1e9), rectified=rectified)
        skeletons = stack.enter_context(skeleton_bag(out)) if out is not None else None
        if images is None:  # after the input was looked at: to load the detector takes seconds
            images = ImageRetriever(make_detector("mediapipe"), Retriever(recorded=True))
            stack.callback(images.close)
        total = sum(bag.counts.get(topic, 0) for topic in topics)
        tally = _Tally()

        def count() -> None:
            tally.messages += 1
            if on_progress is not None:
                on_progress(tally.messages, total)

        for found in reader.images(on_message=count):
            try:
                retrieved = images.process(found.image)
            except RetrieverError as error:
                reader.drop(error)
                continue
            tally.add(retrieved)
            if on_image is not None:
                on_image(found, retrieved)
            if skeletons is not None:
                header = Header(frame_id=found.frame_id)
                header.stamp.sec, header.stamp.nanosec = divmod(found.stamp, 1_000_000_000)
                skeletons.write(skeleton_array(retrieved.skeletons, header), found.time)
    return tally.report(recording, topics, reader, bag, images.newcomer_images)


class _Tally:
    """Counts messages, images, people and how their keypoints were found."""

    def __init__(self) -> None:
        self.messages = 0
        self._with_people = 0
        self._ids: set[int] = set()
        self._times: list[tuple[float, float]] = []
        self._most_people = 0
        self._people_left_out = 0
        self._depths: list[tuple[float, float]] = []
        self._statuses: dict[str, Counter[int]] = {"body": Counter(), "hands": Counter(), "face": Counter()}

    def add(self, retrieved: Retrieved) -> None:
        """Count an image."""
        self._with_people += bool(retrieved.skeletons)
        self._times.append((retrieved.detector_time, retrieved.own_time))
        self._most_people = max(self._most_people, len(retrieved.people))
        self._people_left_out = max(self._people_left_out, retrieved.people_left_out)
        self._depths.append((retrieved.depth_share, retrieved.depth_median))
        for skeleton in retrieved.skeletons:
            self._ids.add(skeleton.track_id)
            if skeleton.is_signer:
                self._statuses["body"].update(skeleton.body.status.tolist())
                self._statuses["hands"].update(skeleton.left_hand.status.tolist())
                self._statuses["hands"].update(skeleton.right_hand.status.tolist())
                self._statuses["face"].update(skeleton.face.status.tolist())

    def _nobody(self, least_images: int | None) -> str:
        if self._ids or not self._most_people:
            return ""
        shares, medians = np.transpose(self._depths)
        known = medians[np.isfinite(medians)]
        return nobody_in_space(
            images=len(self._times),
            most_people=self._most_people,
            share=float(shares.mean()),
            median=float(np.median(known)) if len(known) else float("nan"),
            least_images=least_images,
        )

    def report(
        self, recording: Path, topics: Topics, reader: BagImages, bag: Bag, least_images: int | None
    ) -> RetrievalReport:
        """Sum up, after the last image."""
        detector, own = np.median(self._times, axis=0) if self._times else (np.nan, np.nan)
        return RetrievalReport(
            recording=recording,
            topics=topics,
            images=len(self._times),
            images_with_people=self._with_people,
            people=len(self._ids),
            statuses=self._statuses,
            detector_time=float(detector),
            own_time=float(own),
            left_out=dict(reader.dropped),
            reasons=dict(reader.reasons),
            nobody=self._nobody(least_images),
            people_left_out=self._people_left_out,
            damage=bag.problem,
        )
