# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "teo_bringup"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/launch", sorted(map(str, Path("launch").glob("*.launch.py")))),
        (f"share/{PACKAGE}/config", sorted(map(str, Path("config").glob("*.*")))),
        (f"share/{PACKAGE}/config/network", sorted(map(str, Path("config/network").glob("*.xml")))),
    ],
    install_requires=["PyYAML", "typer"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Launch files, parameters in a file, and nodes kept up without launch.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        "console_scripts": [
            "up = teo_bringup.up:main",
            "network = teo_bringup.network:main",
            "discovery_server = teo_bringup.network:run_discovery_server",
        ]
    },
)
