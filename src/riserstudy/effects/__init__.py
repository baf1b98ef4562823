"""One physical idea a file: a record, its force, its tangent, its energy or its power."""
