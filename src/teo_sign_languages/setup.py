# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "teo_sign_languages"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        *(
            (
                f"share/{PACKAGE}/{folder}",
                sorted(str(path) for path in folder.glob("[!.]*") if path.is_file()),
            )
            for folder in sorted(path for path in Path("languages").rglob("*") if path.is_dir())
        ),
    ],
    install_requires=["msgspec"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Sign languages as data: alphabet, numbers, text side, models, scores, tables.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
)
