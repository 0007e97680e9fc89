# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
"""`retrieve`: skeletons from a bag, or from one image, without ROS running."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from teo_skeleton_retriever.bags.bag_images import BagImage
from teo_skeleton_retriever.camera.rgbd_image import RgbdImage, read_rgbd_image
from teo_skeleton_retriever.camera.synchroniser import DEFAULT_SLOP, GREATEST_SLOP
from teo_skeleton_retriever.detectors import DETECTORS, make_detector
from teo_skeleton_retriever.errors import RetrieverError, TopicError
from teo_skeleton_retriever.image_retriever import (
    COMPAT_MODES,
    ImageRetriever,
    Retrieved,
    make_retriever,
    nobody_in_space,
)
from teo_skeleton_retriever.layouts.skeleton_3d import KeypointStatus
from teo_skeleton_retriever.node.node_parameters import (
    detector_options_from,
    parameters_from_words,
)
from teo_skeleton_retriever.output.messages import as_json
from teo_skeleton_retriever.output.overlay import Overlay, OverlayVideo, overlay_video
from teo_skeleton_retriever.recording import RetrievalReport, retrieve_recording

_out = Console()
_err = Console(stderr=True)
# No markup in the help: it would swallow units in brackets.
_app = typer.Typer(add_completion=False, rich_markup_mode=None)


@_app.command()
def _retrieve(
    bag: Annotated[
        Path | None,
        typer.Argument(help="ROS 2 bag (folder, .mcap, .db3) or ROS 1 bag (.bag).", show_default=False),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="MCAP file for the topic /skeletons.")] = None,
    video: Annotated[Path | None, typer.Option(help="MP4 file for the overlay.")] = None,
    color: Annotated[Path | None, typer.Option(help="One colour image, instead of a bag.")] = None,
    depth: Annotated[
        Path | None, typer.Option(help="Its depth: 16 bits in millimetres, or floats in metres.")
    ] = None,
    camera_info: Annotated[
        Path | None, typer.Option(help="Its camera: JSON with width, height, k, d, distortion_model.")
    ] = None,
    as_lines: Annotated[
        bool, typer.Option("--json", help="Print the skeletons as JSON, a line for each image.")
    ] = False,
    detector: Annotated[str, typer.Option(help=f"One of {', '.join(DETECTORS)}.")] = "mediapipe",
    detector_option: Annotated[
        list[str] | None, typer.Option(help="NAME=VALUE of the detector. Repeatable.")
    ] = None,
    compat: Annotated[
        str, typer.Option(help=f"Processing of the original: {' or '.join(filter(None, COMPAT_MODES))}.")
    ] = "",
    compat_option: Annotated[
        list[str] | None, typer.Option(help="group::name=VALUE of the original. Repeatable.")
    ] = None,
    parameter: Annotated[
        list[str] | None,
        typer.Option("--parameter", "-p", help="NAME=VALUE of the retriever; see the node's. Repeatable."),
    ] = None,
    slop: Annotated[
        float, typer.Option(min=0.0, max=GREATEST_SLOP, help="Between the stamps of colour and depth [s].")
    ] = DEFAULT_SLOP,
    rectified: Annotated[
        bool, typer.Option("--rectified", help="The images were rectified: use P of camera_info.")
    ] = False,
    color_topic: Annotated[str, typer.Option(help="Found by itself where only one can be meant.")] = "",
    depth_topic: Annotated[str, typer.Option(help="Likewise.")] = "",
    camera_info_topic: Annotated[str, typer.Option(help="Likewise.")] = "",
) -> None:
    """Find people's bodies, hands and faces in space.

    Exit status: 0 if all went well, 1 if something could not be read or written (what could be was) or nobody
    of those whom the detector saw is in space, 2 for wrong options.

    Examples: retrieve take/ --out skeletons.mcap --video overlay.mp4

    retrieve --color a.png --depth b.png --camera-info c.json --json
    """
    files = (color, depth, camera_info)
    if (bag is None) == (None in files) or (bag is not None and any(files)):
        raise typer.BadParameter("give either a bag, or --color, --depth and --camera-info")
    if bag is None and (out or video):
        raise typer.BadParameter("--out and --video are for bags")
    try:
        chosen = parameters_from_words(parameter or [], detector=detector)
        retriever = make_retriever(chosen, compat, compat_option or [], recorded=True)
        options = detector_options_from(detector_option or [])
    except RetrieverError as error:
        raise typer.BadParameter(error.sentence) from None
    try:
        with ExitStack() as stack:
            images = ImageRetriever(make_detector(detector, **options), retriever)
            stack.callback(images.close)
            if color is not None and depth is not None and camera_info is not None:
                _one(images, color, depth, camera_info, as_lines)
                return
            assert bag is not None
            film = stack.enter_context(overlay_video(video)) if video is not None else None
            progress = stack.enter_context(_progress())
            task = progress.add_task("retrieving", total=None)
            report = retrieve_recording(
                bag,
                images,
                out=out,
                slop=slop,
                rectified=rectified,
                color_topic=color_topic,
                depth_topic=depth_topic,
                camera_info_topic=camera_info_topic,
                on_progress=lambda done, total: progress.update(task, completed=done, total=total),
                on_image=_image_writer(film, as_lines),
            )
    except RetrieverError as error:
        hint = f"; name it: --{error.argument.replace('_', '-')}" if isinstance(error, TopicError) else ""
        _complain(f"{error.code}: {error.sentence}{hint}")
        raise typer.Exit(1) from None
    except OSError as error:
        _complain(f"cannot write {error.filename}: {error.strerror}")
        raise typer.Exit(1) from None
    written = [path for path in (out, video if report.images else None) if path is not None]
    console = _err if as_lines else _out
    console.print(_table(report))
    for path in written:
        console.print(f"wrote {path}", highlight=False, markup=False, soft_wrap=True)
    for complaint in report.complaints:
        _complain(complaint)
    if report.complaints:
        raise typer.Exit(1)


def _image_writer(film: OverlayVideo | None, as_lines: bool) -> Callable[[BagImage, Retrieved], None]:
    """Make the callback that adds an image to the film and prints its skeletons as a line of JSON."""
    overlay = Overlay()

    def show(found: BagImage, retrieved: Retrieved) -> None:
        if film is not None:
            film.add(overlay.draw(found.image, retrieved), found.image.stamp)
        if as_lines:
            print(json.dumps(as_json(found.image.stamp, retrieved.skeletons)))

    return show


def _one(images: ImageRetriever, color: Path, depth: Path, camera_info: Path, as_lines: bool) -> None:
    image = read_rgbd_image(color, depth, camera_info)
    result = images.process(image)
    if as_lines:
        print(json.dumps(as_json(image.stamp, result.skeletons)))
    else:
        _show_one(image, result)
    if result.people and not result.skeletons:
        _complain(
            nobody_in_space(
                images=1,
                most_people=len(result.people),
                share=result.depth_share,
                median=result.depth_median,
                least_images=images.newcomer_images,
            )
        )
        raise typer.Exit(1)


def _show_one(image: RgbdImage, result: Retrieved) -> None:
    for skeleton in result.skeletons:
        table = Table(
            "keypoint", r"x \[m]", r"y \[m]", r"z \[m]", "status", title=f"person {skeleton.track_id}"
        )
        person = as_json(image.stamp, [skeleton])["skeletons"][0]
        for name, keypoint in person["body"].items():
            table.add_row(name, *(f"{value:.3f}" for value in keypoint["position"]), keypoint["status"])
        _out.print(table)
    _out.print(f"{len(result.skeletons)} of {len(result.people)} people whom the detector saw, in space")


def _progress() -> Progress:
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TextColumn("messages"),
        TimeRemainingColumn(),
        console=_err,
        transient=True,
    )


def _table(report: RetrievalReport) -> Table:
    """Show the counts, with what was left out."""
    table = Table(show_header=False)
    table.add_row("images", str(report.images))
    for reason, count in sorted(report.left_out.items()):
        table.add_row(f"left out, {reason}", str(count))
    table.add_row("with people", str(report.images_with_people))
    table.add_row("people", str(report.people))
    for part, counts in report.statuses.items():
        table.add_row(f"signer's {part}", _shares(counts))
    if report.images:
        detector, own = report.detector_time * 1e3, report.own_time * 1e3
        table.add_row("time per image", f"detector {detector:.1f} ms, own {own:.1f} ms (medians)")
    return table


def _shares(counts: Mapping[int, int]) -> str:
    total = sum(counts.values())
    if not total:
        return "-"
    order = (KeypointStatus.MEASURED, KeypointStatus.OPTIMISED, KeypointStatus.HELD, KeypointStatus.LOST)
    return ", ".join(
        f"{status.name.lower()} {100.0 * counts.get(status, 0) / total:.0f} %" for status in order
    )


def _complain(sentence: str) -> None:
    _err.print(f"retrieve: {sentence}", style="red", markup=False, highlight=False, soft_wrap=True)


def main() -> None:
    """Run the command line."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="backslashreplace")  # type: ignore[union-attr]
    _app()


if __name__ == "__main__":
    main()
