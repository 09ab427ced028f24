"""The same quantities as balls with proven radii, from the exact inputs."""
