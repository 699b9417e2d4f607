"""Starts an X server for VTK. Debian's VTK needs one even for pictures in files; Xvfb is one without a display."""
import atexit
import os
import shutil
import subprocess

from run_files import stop

started = False


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
    arguments = ["Xvfb", "-displayfd", "1", "-screen", "0", "1600x1200x24", "-nolisten", "tcp"]
    server = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    atexit.register(close_screen, server)
    number = server.stdout.readline().decode().strip()
    if not number:
        stop("Xvfb does not start")
    os.environ["DISPLAY"] = ":" + number


def close_screen(server):
    server.terminate()
    server.wait()
