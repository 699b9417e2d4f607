"""Starts an X server for VTK. Debian's VTK needs one even for pictures in files; Xvfb is one without a display."""
import atexit
import os
import random
import shutil
import subprocess
import sys

TRIES = 20
started = False


def stop(text):
    """Ends the program with one sentence"""
    sys.exit(os.path.basename(sys.argv[0]) + ": " + text)


def open_screen():
    """Starts Xvfb once and ends it with the program; without Xvfb the user's own display serves"""
    global started
    if started:
        return
    started = True
    if not shutil.which("Xvfb"):
        if not os.environ.get("DISPLAY"):
            stop("VTK needs an X server: install Xvfb (Debian: xvfb), or set DISPLAY")
        return
    for _ in range(TRIES):
        # Random, since the lowest free number may be that of a server that is about to end, and takes the socket with
        # it
        number = random.randrange(100, 30000)
        arguments = ["Xvfb", f":{number}", "-displayfd", "1", "-screen", "0", "1600x1200x24", "-nolisten", "tcp",
                     "-noreset"]
        server = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        if server.stdout.readline().strip():  # it is ready
            atexit.register(close_screen, server)
            os.environ["DISPLAY"] = f":{number}"
            return
        close_screen(server)
    stop("Xvfb does not start")


def close_screen(server):
    server.terminate()
    server.wait()
