# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_sim_driver"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=["numpy", "ruckig"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Simulated joint driver of TEO: executes joint trajectories as the robot would",
    license="Apache-2.0",
    extras_require={"physics": ["mujoco"], "test": ["hypothesis", "pytest", "scipy"]},
    entry_points={
        "console_scripts": [
            "driver_node = teo_sim_driver.node.driver_node:main",
        ],
    },
)
