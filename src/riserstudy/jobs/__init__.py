"""What the rules of the workflow run, as ``python -m riserstudy.jobs.<name>``.

They are part of the package, so that a checkout and a folder of one's own run the same.
"""
