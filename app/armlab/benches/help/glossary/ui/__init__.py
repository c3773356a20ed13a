"""The panel of the page Glossary."""
