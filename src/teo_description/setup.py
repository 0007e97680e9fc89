# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "teo_description"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed", "data/*.csv", "pictures/fonts/*"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/urdf", sorted(map(str, Path("urdf").glob("*.urdf")))),
    ],
    install_requires=["numpy", "pin"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="TEO's URDF, joint groups, limits, self-collision and a renderer without a display.",
    license="Apache-2.0",
    extras_require={
        "pictures": ["av", "opencv-python-headless", "pillow", "rich", "typer"],
        "test": ["pytest"],
    },
    entry_points={
        "console_scripts": [
            "render = teo_description.pictures.render_cli:main",
            "build_urdf = teo_description.urdf.build_urdf:main",
        ],
    },
)
