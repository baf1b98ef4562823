"""The results database: contents of datasets, tables and study files as tables for SQL queries."""
