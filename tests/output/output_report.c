static char help[] = "Writes and prints a report with awkward values: -summary FILE.\n";

#include <output.h>
#include <math.h>

int main(int argc, char **argv)
{
  PetscInt   iterations[] = {3, 14, 15};
  PetscReal  errors[]     = {0.03, 0.04};
  PairReport pairs[]      = {
         {.name           = "joint",
           .force         = {0, 0.5, -1e300},
           .moment        = {1, 2, 3},
           .mortar_force  = {0, -0.5, 1e300},
           .mortar_moment = {-1, -2, -3},
           .normal_force  = 1e300,
           .area          = 0.125,
           .pressure      = 4},
         {.name          = "side",
           .force        = {0, -0.25, 0},
           .mortar_force = {0, 0.25, 0},
           .normal_force = 0.25,
           .area         = 1,
           .pressure     = NAN},
  };
  FaceReport faces[]       = {{.name = "slab.zmin", .reaction = {-1, 0, 0.5}, .moment = {0, 1, 0}}};
  BodyReport body_forces[] = {
    {.name      = "slab",
      .contact  = {0, 0.25, -1e300},
      .reaction = {-1, 0, 0.5},
      .load     = {1, -0.25, 0},
      .residual = {0, 0, -1e300},
      .balance  = 1},
    {.name = "block", .contact = {0, -0.25, 1e300}},
  };
  StepReport steps[] = {
    {.step                = 1,
      .load               = 0.5,
      .constraints        = 81,
      .filter_dofs        = 111,
      .ip_iterations      = 3,
      .ksp_iterations     = iterations,
      .nksp               = 3,
      .amg_applications   = 35,
      .amg_setups         = 2,
      .energy             = -1.0 / 3,
      .kkt_error          = 1e-7,
      .kkt_error_unscaled = 2e-7,
      .gap_min            = -1e-9,
      .complementarity    = 1e-8,
      .action_reaction    = 1e-15,
      .linear             = {.refinements = 3, .amg_rebuilds = 1, .direct = 2, .backward_error = 1e-11},
      .algebraic_error    = 2e-6,
      .error_estimate     = 0.05,
      .body_errors        = errors,
      .contact_force      = {0, 0.25, -1e300},
      .reaction           = {1, 2, 3},
      .npairs             = 2,
      .pairs              = pairs,
      .nfaces             = 1,
      .faces              = faces,
      .nbodies            = 2,
      .bodies             = body_forces,
      .balance            = 1,
      .converged          = PETSC_TRUE,
      .reason             = "converged"},
    {.step            = 2,
      .load           = 1,
      .npairs         = 2,
      .pairs          = pairs,
      .nfaces         = 1,
      .faces          = faces,
      .energy         = NAN,
      .kkt_error      = INFINITY,
      .gap_min        = -INFINITY,
      .error_estimate = NAN,
      .reason         = "line \"search\" failed\\\n\tat once"},
  };
  RunFigure figures[] = {
    {FIGURE_OF_BODY, "von Mises stress", "stress", "slab", 12.5, "MPa", {1e-20, 0.5, 2}, {NAN, NAN, NAN}, 1},
    {FIGURE_OF_FACE, "reaction", "reaction", "slab.zmin", 1e300, "N", {NAN, NAN, NAN}, {-1e300, 0, 1e280}, 1},
    {FIGURE_OF_STRESSED_MODEL, "stress error, estimate", NULL, "", 160, "%", {NAN, NAN, NAN}, {NAN, NAN, NAN}, 2},
  };
  const char   *bodies[]     = {"slab", "block"};
  PetscInt      assemblies[] = {1, 12};
  AccuracyLevel levels[]     = {
        {.refine            = 1,
          .dofs             = 2000,
          .recovery         = 0.06,
          .change           = NAN,
          .error            = 0.06,
          .algebraic        = 1e-5,
          .amg_applications = 12,
          .time             = 0.25},
        {.refine            = 2,
          .dofs             = 13380,
          .recovery         = 0.015,
          .change           = 0.045,
          .error            = 0.015,
          .algebraic        = 2e-5,
          .amg_applications = 15,
          .time             = 2},
  };
  Accuracy    accuracy                 = {.target = 0.01,
                       .share                     = 0.1,
                       .contact                   = PETSC_TRUE,
                       .tolerance                 = 1e-3,
                       .update_tolerance          = 2.5e-4,
                       .updates                   = 20,
                       .nlevels                   = 2,
                       .levels                    = levels,
                       .reached                   = PETSC_TRUE,
                       .end = "requested accuracy reached: the error of the mesh is at most twice the requested one"};
  RunReport   report                   = {.nbodies = 2,
                        .bodies                    = bodies,
                        .assemblies                = assemblies,
                        .problem                   = "caf\xc3\xa9 \"two\"",
                        .dofs                      = 13380,
                        .refine                    = 1,
                        .converged                 = PETSC_FALSE,
                        .nsteps                    = 2,
                        .steps                     = steps,
                        .nfigures                  = 3,
                        .figures                   = figures,
                        .peak_memory_bytes         = 1.5e9,
                        .accuracy                  = &accuracy};
  const char *warnings[]               = {"the \"lid\" never met"};
  char        file[PETSC_MAX_PATH_LEN] = "summary.json";

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-summary", file, sizeof(file), NULL));
  report.reason         = "line search failed";
  report.exit_code      = RUN_FAILED;
  report.nwarnings      = 1;
  report.warnings       = warnings;
  report.ranks          = 1;
  report.time.total     = 2;
  report.time.amg_apply = 1.5;
  report.time.other     = 0.5;
  PetscCall(ReportWriteJSON(PETSC_COMM_WORLD, &report, file));
  PetscCall(ReportWriteJSON(PETSC_COMM_WORLD, &report, file));
  PetscCall(ReportView(&report, PETSC_VIEWER_STDOUT_WORLD));
  report.steps[1].converged = PETSC_TRUE;
  PetscCall(ReportView(&report, PETSC_VIEWER_STDOUT_WORLD));
  report.steps[1].converged = PETSC_FALSE;
  PetscCall(ReportViewTables(&report, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

  testset:
    nsize: {{1 3}}

    test:
      suffix: 1
      filter: (cat; ${PYTHON} ${AMGF_DIR}/tests/output/output_report.py summary.json)
      output_file: output/output_report_1.out

    test:
      suffix: unwritable
      args: -summary nowhere/summary.json
      filter: Error: grep -o "cannot write .*" | sort -u
      output_file: output/output_report_unwritable.out

TEST*/
