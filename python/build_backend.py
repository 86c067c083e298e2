# SPDX-License-Identifier: Apache-2.0
"""What pip asks to build the package (PEP 517): drives CMake, and packs what that installs. Standard library only.

The compiled module is that of build/release if that is of this interpreter, otherwise of a build of its own in
build/python-..., which takes some minutes. `pip install . --config-settings build=DIR` names another one.
"""
import base64
import hashlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUFFIX = sysconfig.get_config_var("EXT_SUFFIX")  # .cpython-311-x86_64-linux-gnu.so
VERSION = re.search(r"project\(stiction VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
METADATA = f"""Metadata-Version: 2.1
Name: stiction
Version: {VERSION}
Summary: Contact forces with friction by pivoting: solved, replayed, certified
License: GPL-3.0-only
Requires-Python: >=3.9
Requires-Dist: numpy
"""


def _run(*command):
    subprocess.run([str(word) for word in command], check=True)


def _built(settings):
    """The folder of a build that has the module for this interpreter."""
    if not (shutil.which("cmake") and shutil.which("ninja")):
        sys.exit("stiction: found no cmake or no ninja, expected both; ./run python names all that is missing")
    release = ROOT / "build/release"
    usual = release if (release / f"python/package/stiction/_stiction{SUFFIX}").exists() else (
        ROOT / f"build/python{SUFFIX.removesuffix('.so')}")
    build = Path((settings or {}).get("build", usual))
    if not (build / "build.ninja").exists():
        _run("cmake", "-G", "Ninja", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
             f"-DPYTHON_EXECUTABLE={sys.executable}")
    _run("cmake", "--build", build, "--target", "stiction_python", "stiction_python_package")
    return build


def _digest(content):
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    tag = "cp{0}{1}-cp{0}{1}-{2}".format(*sys.version_info[:2], re.sub(r"[-.]", "_", sysconfig.get_platform()))
    info = f"stiction-{VERSION}.dist-info"
    with tempfile.TemporaryDirectory() as prefix:
        _run("cmake", "--install", _built(config_settings), "--component", "python", "--prefix", prefix)
        package = Path(prefix) / "lib/python3/dist-packages/stiction"
        files = {f"stiction/{file.name}": file.read_bytes() for file in sorted(package.iterdir()) if file.is_file()}
    if f"stiction/_stiction{SUFFIX}" not in files:
        sys.exit(f"stiction: found a build for another Python, expected one for {sys.executable}: remove build/python*")
    files[f"{info}/METADATA"] = METADATA.encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: stiction\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = "".join(f"{name},{_digest(content)},{len(content)}\n" for name, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"stiction-{VERSION}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, stdout=subprocess.PIPE).stdout
    name = f"stiction-{VERSION}"
    with tempfile.NamedTemporaryFile("w", suffix="PKG-INFO") as metadata:
        metadata.write(METADATA)
        metadata.flush()
        with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
            archive.add(metadata.name, f"{name}/PKG-INFO")
            for file in listed.decode().split("\0"):
                if file:
                    archive.add(ROOT / file, f"{name}/{file}")
    return f"{name}.tar.gz"
