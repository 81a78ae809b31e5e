//! Raw ground → a checked TIN: points are triangulated, faces turned up, defects told with their places.
