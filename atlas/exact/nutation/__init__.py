"""The machinery of motions whose axis nutates: quartics, theta functions, the pair (alpha, beta)."""
