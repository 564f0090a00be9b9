"""SenseDSL: from a list of sensors to the best wiring, its firmware and its host application.

The package holds the program ``sensedsl``; ``python -m sensedsl`` runs it where its folder is not on the path.
"""
