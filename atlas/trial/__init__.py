"""The paper on trial: the ledger of its equations, and their proofs."""
