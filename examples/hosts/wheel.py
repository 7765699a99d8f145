# SPDX-License-Identifier: MIT
"""wheel.py FOLDER - kit.py with a compiled library inside, as a wheel: no network, no tool but a C compiler and Python

    python3 wheel.py build && pip install build/waveform_iqn_rk-*.whl
    >>> import waveform_iqn_rk as kit

wheel.py FOLDER --test makes it, installs it into a fresh virtual environment that sees the system's NumPy, and runs kit_test.py
there, without a compiler.  Reads CC."""
import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

here = Path(__file__).resolve().parent
headers = here.parents[1]


def library():
    """libkit.so as kit.py compiles it, by kit.py."""
    with tempfile.TemporaryDirectory() as cache:
        environment = {k: v for k, v in os.environ.items() if k != "KIT_LIBRARY"}
        subprocess.run([sys.executable, "-c", "import kit"], cwd=here, check=True,
                       env=dict(environment, XDG_CACHE_HOME=cache, PYTHONDONTWRITEBYTECODE="1"))
        return next(Path(cache).glob("*/libkit-*.so")).read_bytes()


def wheel(folder):
    number = int(re.search(r"#define WF_VERSION (\d+)", (headers / "waveform.h").read_text()).group(1))
    version = f"{number // 10000}.{number // 100 % 100}.{number % 100}"
    tag = "py3-none-" + re.sub(r"[-.]", "_", sysconfig.get_platform())
    info = f"waveform_iqn_rk-{version}.dist-info"
    files = {"waveform_iqn_rk/__init__.py": (here / "kit.py").read_bytes(),
             "waveform_iqn_rk/libkit.so": library(),
             f"{info}/licenses/LICENSE": (headers / "LICENSE").read_bytes(),
             f"{info}/METADATA": f"""Metadata-Version: 2.1
Name: waveform-iqn-rk
Version: {version}
Summary: Waveforms in time, interface quasi-Newton acceleration, Runge-Kutta tables
License: MIT
Requires-Python: >=3.8
Requires-Dist: numpy
""".encode(),
             f"{info}/WHEEL": f"Wheel-Version: 1.0\nGenerator: wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()}
    digest = lambda data: base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    record = [f"{name},sha256={digest(data)},{len(data)}" for name, data in files.items()]
    files[f"{info}/RECORD"] = "\n".join([*record, f"{info}/RECORD,,", ""]).encode()
    path = Path(folder) / f"waveform_iqn_rk-{version}-{tag}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes every time
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
    return path


def test(path):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", folder], check=True)
        python = Path(folder) / "bin" / "python"
        subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", path], check=True)
        code = f"""import runpy, sys, waveform_iqn_rk
sys.modules["kit"] = waveform_iqn_rk
assert {folder!r} in waveform_iqn_rk.__file__
runpy.run_path({str(here / 'kit_test.py')!r})"""
        environment = {k: v for k, v in os.environ.items() if k not in ("KIT_LIBRARY", "PYTHONPATH")}
        subprocess.run([python, "-c", code], cwd=folder, check=True,
                       env=dict(environment, CC="false", XDG_CACHE_HOME=folder + "/none"))


if __name__ == "__main__":
    made = wheel(sys.argv[1])
    print("wheel", made)
    print("kilobytes", made.stat().st_size // 1000)
    if "--test" in sys.argv:
        test(made)
