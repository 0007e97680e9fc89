# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_ros2cli"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/config", ["config/fastdds.xml"]),
    ],
    install_requires=["argcomplete", "mcap", "numpy", "PyYAML"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="A ros2 command for machines whose ROS 2 comes from PyPI; steps aside for the genuine one.",
    license="Apache-2.0",
    extras_require={
        "foreign_bags": ["rosbags"],
        "test": ["pytest", "hypothesis", "mcap-ros2-support", "rosbags"],
    },
    scripts=["bin/ros2"],
)
