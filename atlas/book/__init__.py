"""Report definitions to HTML pages and to PDF."""
