"""The results database: what datasets, tables and study files hold, as tables that can be asked."""
