"""Scenes S1, S2c and S3 in other simulators, a file each, all with the same three names.

- ``available()``: why this peer cannot run here, or None.
- ``LADDER``: settings (elements, step in s, further options) from coarse to fine, among them the
  cheapest found for errors of about 5, 1, 0.2 and 0.05 %.
- ``run(elements, step, **options)``: simulate, and return a dictionary of

  - S1: ``x`` (m) at places ``s`` (m), ``moment`` (N m) at places ``moment_s``;
  - S2c: ``time`` (s, every 0.05 s) and ``x`` (m, over time and the four stations); with ``moments=True``
    also ``moment`` (N m, over the method's own times and places) and ``moment_s`` (m);
  - S3: ``bottom`` (m) and ``top_tension`` (N) every 0.05 s;
  - ``seconds`` of the processor for the simulation alone, without imports, model and statics;
  - ``meta``: ``scheme``, ``step`` (the one used, s), ``failed`` (False, True or the reason), ``version``
    of a package, and ``iterations`` in all where a method knows them.
"""
