"""Files that refer to other files, or declare more values than memory holds, are refused with one error."""

import base64
import zlib

import netCDF4
import numpy as np
import pytest

from riserstudy.dataset.open import open_dataset
from riserstudy.dataset.other_files import refuse_other_files
from riserstudy.errors import InputError
from riserstudy.importers.capytaine import from_capytaine
from riserstudy.seas.record import read_record

#: HDF5 files, compressed, whose values are in the file `secret` or `secret.nc` beside them
REFERRING = {
    "external data, earliest": (
        "eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8KdrCi8mHyCVCaEUp3QOkVTDBxRrCcBFRcEGo+urqQIFdXkOr/aABmTwELhO"
        "ZgGAUjEXi4OgaA6AgoH5ZKTzChqssoRk2PHhTay8jABjGLEcaHpGRGRogAzHoYzQyUB8kIKthD06oDgwk3g8l/Zog8"
        "K1AUJM/ExAQ2gJ1BA8xnhOYVAxzpHOZfDqj9zIywHCKApjKCLvGggOauABZUdcWpyUWpJYh4gKkL9vN3AfkT5j8F5t"
        "G0TQ4AAKi7O54="
    ),
    "link, earliest": (
        "eNrr9HBx4+WS4mIAAQ4OBhYGAQZk8B8KCphR+TD5BCjNCKU7oPQKJpg4C1hOAiouADVfAWpeAFQ8JMjVFdl8dHtGwc"
        "gGHq6O4KQSAeVzQOkTTKjqYOkwgEr2MsFTLvaUyQV0CSOSejaoekYOB6aMYmBaL05NLkot0ctLZtDPz0tlAABf2z6C"
    ),
    "external data, latest": (
        "eNrr9HBx4+WS4mLm4GCAgf8wwAjhG0DFy1eyPvD3cAliYqhgEkJRCAVcTAxALWy8DECKKaN4M8xAdwZqgc+hgsJgJz"
        "AyMDKKMDAwMTIyMkHlYDSzCAOjoII9A8RDDgwm3Awm/5kZGFiBrmPmYtcA6mQAuZCRYT/UgxxotghAaQ6gL5kZYb6D"
        "iTK0MAwKEFm3cI2Hq2MAiK2A5vL7jKhqi1OTi1JLQL5GVQcABMs2LQ=="
    ),
    "link, latest": (
        "eNrr9HBx4+WS4mLm4GCAgf9QsBnKN4DSU0PDuv09XIKYGCqYhJAVwgAXEwMjAwObBAMDI4cDU0axAANDcWpyUWqJXl"
        "4yg35+XioDgw0DReCnscQkAD36JmQ="
    ),
    "virtual dataset": (
        "eNrt1kFKw0AUBuD/zUQbE6qmZiFd1QuIi+JOqliaLgqRQE4QAoFCF8aFV8gtvIPewbu49QBtTGZg3LkQSuH/IAzz3p"
        "vhJZuXZjlfDINxoH0f1tbAZb+/MfGHphmky3mm8KpGbqEVKAhwPES7qKp+txcm+C/feXTRtXAl9cnafSASA0pElKm1"
        "q44h0WSG/gXvMQ0x3WrgqO1Wh/4p4GmT/Gkf+MBBevq6y0FERPQXyWO66obeuTMAuzGJ34G6LJ7Ll+tNgaqGdhJ21H"
        "YxJeZQ+wOA7PbTsxVvZ/zWRERERERERPuyAy7yMk4="
    ),
}
VALUES = [4.0, 7.0]


@pytest.fixture(params=REFERRING)
def referring(request, tmp_path, monkeypatch):
    """A file with values that are in another one."""
    monkeypatch.chdir(tmp_path)
    np.array(VALUES).tofile("secret")
    with netCDF4.Dataset("secret.nc", "w") as file:
        file.createDimension("n", 2)
        file.createVariable("hs", "f8", ("n",))[:] = VALUES
        file.createVariable("one", "f8", ())[:] = VALUES[0]
    path = tmp_path / "from_somebody.nc"
    path.write_bytes(zlib.decompress(base64.b64decode(REFERRING[request.param])))
    return path


def test_a_file_that_refers_to_others_is_refused_although_the_library_reads_it(referring):
    with netCDF4.Dataset(referring) as file:
        assert file["hs"][...].tolist() in (VALUES, VALUES[0])
    for read in (open_dataset, read_record, from_capytaine, refuse_other_files):
        with pytest.raises(InputError, match="references to other files"):
            read(referring)


def test_commands_refuse_it(referring, commands):
    for words in (("table", referring, "-o", "x.csv"), ("seas", referring)):
        code, out, said = commands(*words)
        assert (code, out) == (2, "")
        assert "from_somebody.nc: contains references to other files" in " ".join(said.split())


@pytest.mark.parametrize("seed", range(8))
def test_files_with_all_values_inside_are_read(seed, tmp_path):
    """Whatever they contain: numbers of all kinds, text, groups, many attributes, compressed or not."""
    draw, path = np.random.default_rng(seed), tmp_path / "own.nc"
    with netCDF4.Dataset(path, "w", format="NETCDF4" if seed % 4 else "NETCDF3_CLASSIC") as file:
        groups = [file] + [file.createGroup(f"g{k}") for k in range(seed % 4)]
        for group in groups:
            group.createDimension("n", 400)
            for k, kind in enumerate(("f8", "f4", "i4", "i2", "i1")):
                packed = {"zlib": True} if draw.random() < 0.5 and seed % 4 else {}
                values = draw.integers(-2, 9, 400) if k > 1 else draw.normal(size=400)
                group.createVariable(f"v{k}", kind, ("n",), **packed)[:] = values
            for k in range(int(draw.integers(0, 40))):
                group.setncattr(f"about_{k}", "@ \x01" * int(draw.integers(1, 90)))
            if seed % 4:
                names = np.array([f"name {k}\x01@" for k in range(400)], dtype=object)
                group.createVariable("name", str, ("n",))[:] = names
    refuse_other_files(path)
    assert open_dataset(path).sizes == {"n": 400}


@pytest.mark.parametrize("inside", ["", "part"])
def test_a_file_that_declares_terabytes_is_one_error(tmp_path, commands, inside):
    path = tmp_path / "huge.nc"
    with netCDF4.Dataset(path, "w") as file:
        group = file.createGroup(inside) if inside else file
        group.createDimension("time", 10**12)
        group.createVariable("hs", "f8", ("time",), chunksizes=(10**6,))
    for words in (("table", path, "-o", tmp_path / "x.csv"), ("seas", path)):
        code, out, said = commands(*words)
        assert (code, out) == (2, "")
        assert "huge.nc: the values require 8000 GB" in " ".join(said.split())
