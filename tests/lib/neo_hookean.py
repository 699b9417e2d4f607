"""A neo-Hookean block with unit sides that is compressed or stretched along one axis: a closed form."""


def uniaxial(height, young, poisson):
    """Width and compressive force of the block at a given height. The width minimizes the energy."""
    mu, kappa, step = young / 2 / (1 + poisson), young / 3 / (1 - 2 * poisson), 1e-6

    def energy(height, width):
        volume = height * width**2
        return mu / 2 * (volume**(-2 / 3) * (height**2 + 2 * width**2) - 3) + kappa / 2 * (volume - 1)**2

    low, high = 0.5, 3.0
    for _ in range(60):
        width = (low + high) / 2
        if energy(height, width + step) > energy(height, width - step):
            high = width
        else:
            low = width
    return width, (energy(height - step, width) - energy(height + step, width)) / (2 * step)
