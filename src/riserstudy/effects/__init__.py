"""One file per physical effect: a record, its force, its tangent, and its energy or its power."""
