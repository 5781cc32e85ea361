"""Builds the wheel of the program: cargo builds it with the features of the whole workspace, so that nothing that is there is
built again, and the wheel installs it under a name of its own."""

import base64
import hashlib
import os
import platform
import stat
import subprocess
import sysconfig
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def build_wheel(wheel_directory: str, config_settings: object = None, metadata_directory: object = None) -> str:
    """The hook of PEP 517: writes the wheel, and returns its name."""
    subprocess.run(["cargo", "build", "--locked", "--release", "--bin", "verify"], cwd=ROOT, check=True)
    suffix = sysconfig.get_config_var("EXE") or ""
    target = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
    project = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    version = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    # Python may be for several processors; the program is for this one.
    place = sysconfig.get_platform().replace("universal2", platform.machine())
    tag = f"py3-none-{place.replace('-', '_').replace('.', '_')}"
    name = f"{project['name'].replace('-', '_')}-{version}"
    metadata = [
        "Metadata-Version: 2.4",
        f"Name: {project['name']}",
        f"Version: {version}",
        f"Summary: {project['description']}",
        f"Requires-Python: {project['requires-python']}",
        f"License-Expression: {project['license']}",
        "Description-Content-Type: text/markdown",
        "",
        (HERE / project["readme"]).read_text(encoding="utf-8"),
    ]
    wheel = ["Wheel-Version: 1.0", "Generator: unfair-toss", "Root-Is-Purelib: false", f"Tag: {tag}", ""]
    files = {
        f"{name}.data/scripts/{project['name']}{suffix}": (target / "release" / f"verify{suffix}").read_bytes(),
        f"{name}.dist-info/METADATA": "\n".join(metadata).encode(),
        f"{name}.dist-info/WHEEL": "\n".join(wheel).encode(),
    }
    record = f"{name}.dist-info/RECORD"
    files[record] = "".join([*map(_recorded, files.items()), f"{record},,\n"]).encode()
    path = Path(wheel_directory, f"{name}-{tag}.whl")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for file, content in files.items():
            entry = zipfile.ZipInfo(file)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, (stat.S_IFREG | 0o755) << 16
            archive.writestr(entry, content)
    return path.name


def build_sdist(sdist_directory: str, config_settings: object = None) -> str:
    """The hook of PEP 517."""
    raise NotImplementedError("the program is built in a clone: pip install ./bindings/verify")


def _recorded(file: tuple[str, bytes]) -> str:
    """A file's line in RECORD."""
    name, content = file
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"
