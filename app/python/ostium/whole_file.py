"""Files that appear whole or not at all."""

import os
from pathlib import Path


def write_whole(path, content: bytes) -> None:
    """What was there stays until all of the new one is written beside it. Raises OSError with `path`."""
    place = Path(os.path.realpath(path))
    if place.exists() and not place.is_file():  # a device, a pipe
        place.write_bytes(content)
        return
    beside = place.with_name(place.name + ".unfinished")
    try:
        with open(beside, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        beside.replace(place)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise OSError(error.errno, error.strerror, str(path)) from None
