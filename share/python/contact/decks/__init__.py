"""Decks of Abaqus and CalculiX as scenes"""
