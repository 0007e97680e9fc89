# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_common"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=["PyYAML", "mcap", "msgspec", "numpy", "zstandard"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="What the packages share: text, files, parameters, diagnostics, running a node.",
    license="Apache-2.0",
    extras_require={"test": ["hypothesis", "pytest"]},
)
