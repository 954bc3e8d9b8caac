"""Processes one batch of a data set: runs the program on each mesh within limits, and draws and records the results.

Usage: run_meshes.py OPTIONS NUMBER RECORDS     (OPTIONS: in JSON; RECORDS: written when the batch is complete)

Every mesh has a folder, in which record.json is written last. A mesh that has a record for the same file and options is
not processed again. All problems of a mesh are stored in its record. This script fails only if it cannot write.
"""
import json
import multiprocessing
import os
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import data_set

PARTS = {"mesh": ("_mesh.ply", "_failed_mesh.ply"), "simplified": ("_simplified.ply",), "places": ("_failed_places.ply",),
         "inner": ("_inner.ply",), "outer": ("_outer.ply",), "shell": (".shell",)}     # files of the option `keep`
OUTCOMES = {1: "refused", 2: "wrong usage", 3: "a file cannot be written", 4: "not certified"}
DRAWING_SECONDS, ATTEMPTS = 120, 2
THUMBNAIL = 320, 120


def write(path, text):
    """Writes a complete file, or no file."""
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def limit_memory(megabytes):
    resource.setrlimit(resource.RLIMIT_DATA, (megabytes * 10**6, megabytes * 10**6))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Drawing:
    """Draws pictures in forks of this process, because a process that loses the X server ends.

    Python, VTK and the server are started only once.
    """

    def __init__(self):
        self.server = None

    def start(self):
        from PIL import Image
        sys.path.append(str(Path(__file__).resolve().parents[1]))
        os.environ["LP_NUM_THREADS"] = "1"      # threads of the software renderer
        import render_shell
        self.renderer, self.image = render_shell, Image
        read, write_end = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1280x1024x24"], pass_fds=[write_end],
                                       stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(read) as number:
            os.environ["DISPLAY"] = ":" + number.readline().strip()

    def stop(self):
        if self.server:
            self.server.terminate()
            self.server.wait()
            self.server = None

    def _draw(self, prefix, picture, megabytes, log):
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        with open(log, "ab", buffering=0) as out:
            os.dup2(out.fileno(), 1)
            os.dup2(out.fileno(), 2)
        limit_memory(megabytes)
        self.renderer.main(str(prefix), str(picture))
        with self.image.open(picture) as image:
            small = image.convert("RGB")
            small.thumbnail(THUMBNAIL)
            small.save(picture.with_name("thumbnail.png"))

    def __call__(self, prefix, picture, megabytes, log):
        """Returns whether the picture was drawn."""
        for _ in range(ATTEMPTS):
            if not self.server or self.server.poll() is not None:
                self.start()
            process = multiprocessing.get_context("fork").Process(target=self._draw, args=(prefix, picture, megabytes, log))
            process.start()
            try:
                process.join(DRAWING_SECONDS)
            finally:
                process.kill()
                process.join()
            if process.exitcode == 0:
                return True
        return False


def run(command, seconds, megabytes, result, log):
    """Returns the exit code (negative for a signal), whether the time limit was reached, and times and memory."""
    start = time.monotonic()
    over = threading.Event()
    with open(result, "wb") as out, open(log, "wb") as errors:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=out, stderr=errors,
                                   preexec_fn=lambda: limit_memory(megabytes))

        def end():
            over.set()
            process.kill()
        timer = threading.Timer(seconds, end)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            process.kill()
            raise
        finally:
            timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)      # `wait4()` reports the peak memory
    return process.returncode, over.is_set(), {
        "seconds": round(time.monotonic() - start, 3), "cpu_seconds": round(usage.ru_utime + usage.ru_stime, 3),
        "peak_mb": round(usage.ru_maxrss * 1024 / 10**6, 1)}


def first_line(log):
    with open(log, encoding="utf-8", errors="replace") as text:
        return next((line.strip() for line in text if line.strip()), "")


def outcome(code, over, result, log, options):
    """Returns the outcome in two or three words, which are counted, and in a sentence without the file name."""
    said = (result or {}).get("error") or first_line(log)
    if over:
        return "time limit", f"The program was stopped at the time limit of {options['time_limit']} s."
    if said.startswith("The time limit was reached"):
        return "time limit", said
    if "std::bad_alloc" in log.read_text(encoding="utf-8", errors="replace"):
        return "memory limit", f"The program needs more than the memory limit of {options['memory_limit']} MB."
    if code < 0:
        return "crashed", f"The program ended with {signal.Signals(-code).name}. {said}".strip()
    if code == 0:
        return "done", ""
    return OUTCOMES.get(code, "crashed"), said or f"The program ended with exit code {code}."


def read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def make(name, file, options, folder, draw):
    """Returns the record of a mesh, which is processed unless the record is complete."""
    made_from = data_set.state(file)
    made_with = {key: options[key] for key in ("checksum", "facets", "time_limit", "memory_limit", "pictures", "keep")}
    old = read_json(folder / "record.json")
    if old and old["made_from"] == made_from and old["made_with"] == made_with:
        return old
    # If a mesh kills this process, for example by limits of a cluster, the number of attempts is limited.
    mark = folder / "running"
    deaths = int(mark.read_text() or 0) if mark.exists() else 0
    if deaths < ATTEMPTS:
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        mark.write_text(str(deaths + 1))

    prefix, log, picture = folder / name, folder / "log.txt", folder / "picture.png"
    record = {"name": name, "file": str(file), "made_from": made_from, "made_with": made_with}
    try:
        if deaths >= ATTEMPTS:
            record |= {"outcome": "killed", "reason": "The job died twice while it processed this mesh.", "exit": None}
        else:
            command = [options["program"], "simplify", str(file), "-o", f"{prefix}_simplified.ply", "--shell", str(prefix), "--json",
                       "--threads", "1", "--time-limit", str(0.8 * options["time_limit"]), "--memory-limit", str(options["memory_limit"] / 1.5)]
            command += ["--facets", str(options["facets"])] if options["facets"] else []
            result = folder / "simplified.json"
            code, over, spent = run(command, options["time_limit"], options["memory_limit"], result, log)
            record["simplified"] = read_json(result)
            result.unlink()
            record["outcome"], record["reason"] = outcome(code, over, record["simplified"], log, options)
            record |= {"exit": code, **spent}
            failed = Path(f"{prefix}_failed")
            record["report"] = read_json(Path(f"{prefix if code == 0 else failed}.json"))
            drawn = prefix if code == 0 else failed if Path(f"{failed}_places.ply").exists() else None
            if options["pictures"] and drawn:
                start = time.monotonic()
                record["picture"] = draw(drawn, picture, options["memory_limit"], log)
                record["drawing_seconds"] = round(time.monotonic() - start, 3)
            for part in set(PARTS) - set(options["keep"].split()):
                for ending in PARTS[part]:
                    Path(f"{prefix}{ending}").unlink(missing_ok=True)
    except BaseException:       # the run was terminated, but not because of the mesh
        mark.unlink(missing_ok=True)
        raise
    write(folder / "record.json", json.dumps(record, indent=1))
    mark.unlink(missing_ok=True)
    return record


def main(options, number, output):
    options = json.loads(options)
    options["checksum"] = data_set.checksum(options["program"])
    batch = data_set.batches_of(data_set.files_of(options["meshes"]), options["batch"])[int(number)]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))
    draw = Drawing()
    try:
        records = [make(name, file, options, Path("meshes") / name, draw) for name, file in batch]
    finally:
        draw.stop()
    write(Path(output), "".join(json.dumps(record) + "\n" for record in records))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
