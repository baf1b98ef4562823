"""Files that people write: text, plain YAML, and validation against a model, with readable errors."""
