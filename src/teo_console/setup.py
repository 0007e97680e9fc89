# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "teo_console"


def web_files() -> list[tuple[str, list[str]]]:
    """The page, folder by folder."""
    folders = sorted({path.parent for path in Path("web").rglob("*") if path.is_file()})
    return [
        (f"share/{PACKAGE}/{folder}", sorted(str(path) for path in folder.iterdir() if path.is_file()))
        for folder in folders
    ]


setup(
    name=PACKAGE,
    version="0.2.0",
    packages=find_packages(exclude=["test", "test.*"]),
    package_data={PACKAGE: ["py.typed"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml", "protocol.schema.json"]),
        *web_files(),
    ],
    install_requires=["aiohttp", "av", "msgspec", "segno"],
    zip_safe=False,
    maintainer="TEO signing project",
    maintainer_email="teo-sign@example.org",
    description="The console: a page in the browser that shows what TEO signs, and the node that serves it.",
    license="Apache-2.0",
    extras_require={"test": ["axe-playwright-python", "playwright", "pytest"]},
    entry_points={"console_scripts": ["console_node = teo_console.node.console_node:main"]},
)
