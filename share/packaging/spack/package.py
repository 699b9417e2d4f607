from spack.package import *


class Amgf(MakefilePackage):
    """AMG with filtering (-pc_type amgf) and an interior point method (-tao_type ipfilter) for PETSc,
    and the program contact for contact mechanics."""

    # No public address yet: spack install amgf, with `spack develop --path FOLDER amgf@0.1.0`
    version("0.1.0")

    variant("contact", default=True, description="The program contact and its library, beside the plugin")

    depends_on("c", type="build")
    depends_on("gmake", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi")
    depends_on("petsc@3.18: +mpi+hypre+mumps+shared")
    depends_on("petsc +hdf5~complex", when="+contact")
    depends_on("hdf5 +mpi", when="+contact")
    depends_on("metis", when="+contact")
    depends_on("libyaml", when="+contact")
    depends_on("python@3.9:", type=("build", "run"))
    with when("+contact"), default_args(type="run"):
        depends_on("py-numpy")
        depends_on("py-h5py")
        depends_on("py-pyyaml")
        depends_on("py-matplotlib")

    def arguments(self):
        words = [f"PREFIX={self.prefix}", f"PETSC_DIR={self.spec['petsc'].prefix}", "PETSC_ARCH=",
                 f"PYTHON={self.spec['python'].command.path}"]
        return words if self.spec.satisfies("+contact") else [*words, "PLUGIN_ONLY=1"]

    def build(self, spec, prefix):
        make("all", *self.arguments())

    def install(self, spec, prefix):
        make("install", *self.arguments())

    def setup_run_environment(self, env):
        env.prepend_path("PYTHONPATH", join_path(self.prefix.share, "amgf", "python"))
