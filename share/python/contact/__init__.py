"""Runs contact, reads its results and its meshes"""
