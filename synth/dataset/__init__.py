"""Datasets on disk: BOP records, truth, contact sheet, integrity and replay."""
