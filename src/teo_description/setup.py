# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "teo_description"
FOLDERS = sorted(folder for folder in Path("robots").rglob("*") if folder.is_dir())

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed", "pictures/fonts/*"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        *(
            (f"share/{PACKAGE}/{folder}", sorted(str(path) for path in folder.iterdir() if path.is_file()))
            for folder in FOLDERS
        ),
    ],
    install_requires=["msgspec", "numpy", "pin", "scipy"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Humanoids as data: URDF, joint groups, limits, clearance and a renderer without a display.",
    license="Apache-2.0",
    extras_require={
        "pictures": ["av", "opencv-python-headless", "pillow", "rich", "typer"],
        "robots": ["fast-simplification", "trimesh"],  # pictures of robots with meshes
        "test": ["PyYAML", "pytest"],
    },
    entry_points={
        "console_scripts": [
            "render = teo_description.pictures.render_cli:main",
            "robots = teo_description.robots_cli:main",
        ],
    },
)
