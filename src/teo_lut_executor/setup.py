# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_lut_executor"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=["msgspec", "numpy", "rich", "typer"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="The executor: sign tokens in, smooth trajectories out; the commands lut and plan.",
    license="Apache-2.0",
    extras_require={"test": ["hypothesis", "opencv-python-headless", "pytest", "PyYAML"]},
    entry_points={
        "console_scripts": [
            "capture_demonstration = teo_common.installed_packages:main",
            "capture_letters = teo_common.installed_packages:main",
            "capture_numbers = teo_common.installed_packages:main",
            "capture_scores = teo_common.installed_packages:main",
            "capture_node = teo_common.installed_packages:main",
            "executor_node = teo_lut_executor.node.executor_node:main",
            "lut = teo_lut_executor.cli.lut:main",
            "perform_scores = teo_common.installed_packages:main",
            "plan = teo_lut_executor.cli.plan:main",
        ],
    },
)
