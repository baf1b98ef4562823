"""Files that people write: text, plain YAML, and data held against a model, with readable faults."""
