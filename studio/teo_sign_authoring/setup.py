# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from setuptools import find_packages, setup

PACKAGE = "teo_sign_authoring"

setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=[
        "fonttools",
        "msgspec",
        "numpy",
        "pin",
        "pose-format",
        "pydantic",
        "PyYAML",
        "rich",
        "safetensors",
        "scipy",
        "signwriting",
        "spoken-to-signed",
        "threadpoolctl",
        "torch",
        "typer",
    ],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="Writing signs: scores, SignWriting, the manual alphabet, easier postures, other robots.",
    license="Apache-2.0",
    extras_require={"test": ["pytest"]},
    entry_points={
        # What `ros2 run PACKAGE NAME` runs of packages that are without these commands.
        "teo.commands": [
            "capture_demonstration = teo_sign_authoring.cli.capture_table:demonstration_main",
            "capture_letters = teo_sign_authoring.cli.capture_table:letters_main",
            "capture_numbers = teo_sign_authoring.cli.capture_table:numbers_main",
            "capture_scores = teo_sign_authoring.cli.capture_table:scores_main",
            "draw_signwriting = teo_sign_authoring.cli.signwriting:draw_main",
            "ease_letters = teo_sign_authoring.cli.capture_table:ease_letters_main",
            "import_signwriting = teo_sign_authoring.cli.signwriting:import_signwriting",
            "perform_scores = teo_sign_authoring.cli.perform_scores:main",
            "train_lifting = teo_sign_authoring.cli.train_lifting:main",
        ],
        "teo_lut_executor.lut_commands": [
            "ease = teo_sign_authoring.cli.lut_commands:ease",
            "fit = teo_sign_authoring.cli.lut_commands:fit",
            "retarget = teo_sign_authoring.cli.lut_commands:retarget",
        ],
    },
)
