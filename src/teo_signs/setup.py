# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_signs"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml", "sign.schema.json"]),
    ],
    install_requires=["msgspec", "numpy", "scipy"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="A sign and the table of signs: file, schema, evidence, tokens, lexicon, mirroring, export.",
    license="Apache-2.0",
    extras_require={"pictures": ["opencv-python-headless", "pillow"], "test": ["hypothesis", "pytest"]},
)
