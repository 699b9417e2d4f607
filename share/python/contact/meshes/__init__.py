"""Meshes from other programs"""
