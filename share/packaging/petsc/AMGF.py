import os
import config.package

class Configure(config.package.Package):
  def __init__(self, framework):
    config.package.Package.__init__(self, framework)
    self.version         = '0.1.0'
    self.download        = 'NoDefault' # no public address yet: --download-amgf=FILE.tar.gz or FOLDER
    self.functions       = []
    self.includes        = []
    self.providesDocs    = 1
    self.docsDirs        = ['pc_amgf','tao_ipfilter','src/plugin','include']
    self.precisions      = ['double']
    self.linkedbypetsc   = 0
    self.builtafterpetsc = 1
    return

  def setupDependencies(self, framework):
    config.package.Package.setupDependencies(self, framework)
    self.sharedLibraries = framework.require('PETSc.options.sharedLibraries',self)
    self.mpi             = framework.require('config.packages.MPI',self)
    self.blasLapack      = framework.require('config.packages.BlasLapack',self)
    self.hypre           = framework.require('config.packages.hypre',self)
    self.mumps           = framework.require('config.packages.MUMPS',self)
    self.deps            = [self.mpi,self.blasLapack]
    self.odeps           = [self.hypre,self.mumps]
    return

  def Install(self):
    if not self.checkSharedLibrariesEnabled():
      raise RuntimeError('AMGF requires shared libraries')
    # with a prefix, AMGF is built after make install of PETSc
    if self.argDB['prefix'] and not 'package-prefix-hash' in self.argDB:
      prefix = os.path.abspath(os.path.expanduser(self.argDB['prefix']))
      petsc  = 'PETSC_DIR=' + prefix + ' PETSC_ARCH=""'
    else:
      prefix = os.path.join(self.petscdir.dir,self.arch)
      petsc  = 'PETSC_DIR=${PETSC_DIR} PETSC_ARCH=${PETSC_ARCH}'
    make = petsc + ' ${OMAKE} ' + petsc + ' PLUGIN_ONLY=1 PREFIX=' + prefix
    self.include = [os.path.join(prefix,'include')]
    self.lib     = [os.path.join(prefix,'lib','libpetscamgf.' + self.setCompilers.sharedLibraryExt)]
    self.addPost(self.packageDir,[make + ' install'])
    # without -dll_append: PETSc has loaded the library by itself
    examples = os.path.join(self.packageDir,'share','examples')
    found    = 'PKG_CONFIG_PATH=' + os.path.join(prefix,'lib','pkgconfig')
    self.addMakeCheck(examples,found + ' ${OMAKE} CC="${CC}" ties_ksp && ./ties_ksp -pc_type amgf')
    return self.installDir
