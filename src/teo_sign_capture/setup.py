# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_sign_capture"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["*.pyi", "py.typed", "retarget/person_handshapes.tsv"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=[
        "av",
        "distributed",
        "dtaidistance",
        "lazy-loader",
        "msgspec",
        "numpy",
        "opencv-python-headless",
        "pin",
        "pose-format",
        "rich",
        "scipy",
        "threadpoolctl",
        "typer",
    ],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="From a person to a sign: recordings, tracks, retargeting, entries.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "capture_demonstration = teo_common.installed_packages:main",
            "capture_letters = teo_common.installed_packages:main",
            "capture_node = teo_sign_capture.node.capture_node:main",
            "capture_numbers = teo_common.installed_packages:main",
            "capture_scores = teo_common.installed_packages:main",
            "draw_signwriting = teo_common.installed_packages:main",
            "ease_letters = teo_common.installed_packages:main",
            "perform_scores = teo_common.installed_packages:main",
        ],
        "teo_lut_executor.lut_commands": [
            "capture = teo_sign_capture.cli.capture:capture",
            "import = teo_sign_capture.cli.import_pose:import_pose",
            "recognise = teo_sign_capture.cli.recognise:recognise",
            "record = teo_sign_capture.node.record:record",
        ],
        "teo.commands": ["capture_node = teo_sign_capture.node.capture_node:main"],
    },
)
