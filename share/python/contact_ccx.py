"""Starts contact-ccx from this folder, wherever that is"""
import os
import runpy
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
runpy.run_module("contact.decks", run_name="__main__")
