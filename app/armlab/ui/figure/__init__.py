"""An arm drawn from its Denavit-Hartenberg table alone: solids, links, housings, grippers, as GLB bodies."""
