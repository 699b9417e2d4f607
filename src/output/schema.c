/*
   Lists the fields of each report: key, unit, member and type, and the columns in printed tables. The summary has the
   fields in the order of these lists. To add a field, add a member in report.h and a line in this file.
*/
#include "outputimpl.h"
#include <math.h>

/* Describes a field; the last arguments are the unit and initializers of further members of ReportField. */
#define FIELD(record, member, stored, ...) \
  { \
    .name = #member, .offset = offsetof(record, member), .type = stored, .unit = __VA_ARGS__ \
  }
/*
   Describes a column; the arguments after the two lines of the heading are the width and initializers of further
   members of ReportColumn.
*/
#define COLUMN(place, above, below, ...) \
  { \
    .table = place, .head = {above, below}, .width = __VA_ARGS__ \
  }
#define END \
  { \
    .name = NULL \
  }

static const ReportField fallback_fields[] = {
  FIELD(TaoIPFilterFallbacks, refinements, FIELD_INT, "",
    .columns = {COLUMN(TABLE_FALLBACKS, "", "", 0, .format = "%.0f refined")}),
  FIELD(TaoIPFilterFallbacks, amg_rebuilds, FIELD_INT, "",
    .columns = {COLUMN(TABLE_FALLBACKS, "", "", 0, .format = "%.0f with the AMG rebuilt")}),
  FIELD(TaoIPFilterFallbacks, filters, FIELD_INT, "",
    .columns = {COLUMN(TABLE_FALLBACKS, "", "", 0, .format = "%.0f with a larger filter")}),
  FIELD(TaoIPFilterFallbacks, direct, FIELD_INT, "",
    .columns = {COLUMN(TABLE_FALLBACKS, "", "", 0, .format = "%.0f by MUMPS")}),
  FIELD(TaoIPFilterFallbacks, failures, FIELD_INT, "",
    .columns = {COLUMN(TABLE_FALLBACKS, "", "", 0, .format = "%.0f failed")}),
  FIELD(TaoIPFilterFallbacks, backward_error, FIELD_REAL, "",
    .columns = {COLUMN(TABLE_FALLBACKS, "", "", 0, .format = "backward error at most %.1e")}),
  FIELD(TaoIPFilterFallbacks, subspaces, FIELD_INT, ""),
  END,
};
const ReportRecord SchemaFallbacks = {sizeof(TaoIPFilterFallbacks), PETSC_TRUE, fallback_fields};

static const ReportField pair_fields[] = {
  FIELD(PairReport, name, FIELD_TEXT, "", .columns = {COLUMN(TABLE_PAIRS, "pair", "", -24)}),
  FIELD(PairReport, force, FIELD_VECTOR, "force",
    .columns = {COLUMN(TABLE_PAIRS, "force on the nonmortar side", "", -41)}),
  FIELD(PairReport, moment, FIELD_VECTOR, "force length"),
  FIELD(PairReport, mortar_force, FIELD_VECTOR, "force"),
  FIELD(PairReport, mortar_moment, FIELD_VECTOR, "force length"),
  FIELD(PairReport, normal_force, FIELD_REAL, "force",
    .columns = {COLUMN(TABLE_PAIRS, "normal", "", 12, .format = "%.6e")}),
  FIELD(PairReport, area, FIELD_REAL, "length^2", .columns = {COLUMN(TABLE_PAIRS, "area", "", 10, .format = "%.4e")}),
  FIELD(PairReport, narrow, FIELD_BOOL, ""),
  FIELD(PairReport, pressure, FIELD_REAL, "force/length^2",
    .columns = {COLUMN(TABLE_PAIRS, "pressure", "", 10, .format = "%.4e")}),
  FIELD(PairReport, pressure_place, FIELD_VECTOR, "length"),
  FIELD(PairReport, penetration, FIELD_REAL, "length",
    .columns = {COLUMN(TABLE_PAIRS, "penetration", "", 11, .format = "%.4e")}),
  FIELD(PairReport, shear_force, FIELD_REAL, "force"),
  FIELD(PairReport, stick_area, FIELD_REAL, "length^2"),
  FIELD(PairReport, slip_area, FIELD_REAL, "length^2"),
  FIELD(PairReport, dissipated, FIELD_REAL, "force length"),
  END,
};
const ReportRecord SchemaPairs = {sizeof(PairReport), PETSC_TRUE, pair_fields};

static const ReportField face_fields[] = {
  FIELD(FaceReport, name, FIELD_TEXT, "", .columns = {COLUMN(TABLE_FACES, "face", "", -24)}),
  FIELD(FaceReport, reaction, FIELD_VECTOR, "force", .columns = {COLUMN(TABLE_FACES, "reaction", "", -41)}),
  FIELD(FaceReport, moment, FIELD_VECTOR, "force length"),
  FIELD(FaceReport, torque, FIELD_REAL, "force length"),
  END,
};
const ReportRecord SchemaFaces = {sizeof(FaceReport), PETSC_TRUE, face_fields};

static const ReportField rigid_fields[] = {
  FIELD(RigidReport, name, FIELD_TEXT, "", .columns = {COLUMN(TABLE_RIGID, "rigid body", "", -24)}),
  FIELD(RigidReport, position, FIELD_VECTOR, "length", .columns = {COLUMN(TABLE_RIGID, "position", "", -41)}),
  FIELD(RigidReport, rotation, FIELD_VECTOR, "degrees",
    .columns = {COLUMN(TABLE_RIGID, "rotation [degrees]", "", -41)}),
  END,
};
const ReportRecord SchemaRigid = {sizeof(RigidReport), PETSC_TRUE, rigid_fields};

static const ReportField connector_fields[] = {
  FIELD(ConnectorReport, name, FIELD_TEXT, "", .columns = {COLUMN(TABLE_CONNECTORS, "connector", "", -24)}),
  FIELD(ConnectorReport, force, FIELD_VECTOR, "force", .columns = {COLUMN(TABLE_CONNECTORS, "force", "", -41)}),
  FIELD(ConnectorReport, offset, FIELD_VECTOR, "length", .columns = {COLUMN(TABLE_CONNECTORS, "offset", "", -41)}),
  END,
};
const ReportRecord SchemaConnectors = {sizeof(ConnectorReport), PETSC_TRUE, connector_fields};

static const ReportField bolt_fields[] = {
  FIELD(BoltReport, name, FIELD_TEXT, "", .columns = {COLUMN(TABLE_BOLTS, "bolt", "", -24)}),
  FIELD(BoltReport, force, FIELD_REAL, "force", .columns = {COLUMN(TABLE_BOLTS, "tension", "", 14, .format = "%.8e")}),
  FIELD(BoltReport, shortening, FIELD_REAL, "length",
    .columns = {COLUMN(TABLE_BOLTS, "shortening", "", 14, .format = "%.8e")}),
  END,
};
const ReportRecord SchemaBolts = {sizeof(BoltReport), PETSC_TRUE, bolt_fields};

static const ReportField ramp_fields[] = {
  FIELD(RampReport, name, FIELD_TEXT, ""),
  FIELD(RampReport, factor, FIELD_REAL, ""),
  END,
};
static const ReportRecord SchemaRamps = {sizeof(RampReport), PETSC_TRUE, ramp_fields};

#define PROBE_FIELDS \
  FIELD(ProbeReport, place, FIELD_VECTOR, "length"), FIELD(ProbeReport, displacement, FIELD_VECTOR, "length"), \
    FIELD(ProbeReport, stress_xx, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, stress_yy, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, stress_zz, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, stress_xy, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, stress_yz, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, stress_zx, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, von_mises, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, principal_1, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, principal_2, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, principal_3, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, contact_pressure, FIELD_REAL, "force/length^2"), \
    FIELD(ProbeReport, contact_gap, FIELD_REAL, "length"), FIELD(ProbeReport, contact_status, FIELD_REAL, "")

static const ReportField  probe_fields[] = {FIELD(ProbeReport, name, FIELD_TEXT, ""), PROBE_FIELDS, END};
static const ReportRecord SchemaProbes   = {sizeof(ProbeReport), PETSC_TRUE, probe_fields};

static const ReportField line_fields[] = {FIELD(ProbeReport, name, FIELD_TEXT, ""),
  FIELD(ProbeReport, arc, FIELD_REAL, "length"), PROBE_FIELDS, END};
const ReportRecord       SchemaLines   = {sizeof(ProbeReport), PETSC_TRUE, line_fields};

static const ReportField body_fields[] = {
  FIELD(BodyReport, name, FIELD_TEXT, ""),
  FIELD(BodyReport, contact, FIELD_VECTOR, "force"),
  FIELD(BodyReport, reaction, FIELD_VECTOR, "force"),
  FIELD(BodyReport, springs, FIELD_VECTOR, "force"),
  FIELD(BodyReport, ties, FIELD_VECTOR, "force"),
  FIELD(BodyReport, load, FIELD_VECTOR, "force"),
  FIELD(BodyReport, residual, FIELD_VECTOR, "force"),
  FIELD(BodyReport, balance, FIELD_REAL, ""),
  FIELD(BodyReport, plastic_strain, FIELD_REAL, ""),
  FIELD(BodyReport, displacement, FIELD_REAL, "length"),
  FIELD(BodyReport, displacement_place, FIELD_VECTOR, "length"),
  FIELD(BodyReport, von_mises, FIELD_REAL, "force/length^2"),
  FIELD(BodyReport, von_mises_place, FIELD_VECTOR, "length"),
  FIELD(BodyReport, safety, FIELD_REAL, ""),
  END,
};
static const ReportRecord SchemaBodies = {sizeof(BodyReport), PETSC_TRUE, body_fields};

static const ReportField motion_fields[] = {
  FIELD(MotionReport, name, FIELD_TEXT, ""),
  FIELD(MotionReport, kinetic_energy, FIELD_REAL, "force length"),
  FIELD(MotionReport, total_energy, FIELD_REAL, "force length"),
  FIELD(MotionReport, damping_work, FIELD_REAL, "force length"),
  FIELD(MotionReport, numerical_dissipation, FIELD_REAL, "force length"),
  FIELD(MotionReport, rejected_steps, FIELD_INT, ""),
  FIELD(MotionReport, shortest_step, FIELD_REAL, "time"),
  FIELD(MotionReport, time_error, FIELD_REAL, ""),
  FIELD(MotionReport, momentum, FIELD_VECTOR, "force time"),
  FIELD(MotionReport, angular_momentum, FIELD_VECTOR, "force length time"),
  END,
};
static const ReportRecord SchemaMotions = {sizeof(MotionReport), PETSC_TRUE, motion_fields};

static const ReportField step_fields[] = {
  FIELD(StepReport, step, FIELD_INT, "", .columns = {COLUMN(TABLE_EVERY, "step", "", 5)}),
  FIELD(StepReport, time, FIELD_REAL, ""),
  FIELD(StepReport, load, FIELD_REAL, "", .columns = {COLUMN(TABLE_WORK, "load", "factor", 8, .format = "%.4f")}),
  FIELD(StepReport, constraints, FIELD_INT, "", .columns = {COLUMN(TABLE_WORK, "contact", "rows", 8)}),
  FIELD(StepReport, filter_dofs, FIELD_INT, "", .columns = {COLUMN(TABLE_WORK, "filter", "dofs", 8)}),
  FIELD(StepReport, ip_iterations, FIELD_INT, "", .columns = {COLUMN(TABLE_WORK, "ip", "its", 4)}),
  FIELD(StepReport, ksp_iterations, FIELD_INTS, "", .count = offsetof(StepReport, nksp),
    .columns = {COLUMN(TABLE_WORK, "pcg", "its", 6, .shown = SHOWN_SUM),
      COLUMN(TABLE_WORK, "pcg/ip", "", 6, .format = "%.1f", .shown = SHOWN_MEAN)}),
  FIELD(StepReport, amg_applications, FIELD_INT, "", .columns = {COLUMN(TABLE_WORK, "amg", "applic", 6)}),
  FIELD(StepReport, amg_setups, FIELD_INT, "", .columns = {COLUMN(TABLE_WORK, "amg", "set-ups", 7)}),
  FIELD(StepReport, factored, FIELD_BOOL, ""),
  FIELD(StepReport, substeps, FIELD_INT, "", .columns = {COLUMN(TABLE_TRUTH, "solves", "", 6)}),
  FIELD(StepReport, cuts, FIELD_INT, "", .columns = {COLUMN(TABLE_TRUTH, "cuts", "", 5)}),
  FIELD(StepReport, contact_updates, FIELD_INT, "", .columns = {COLUMN(TABLE_TRUTH, "gap", "updates", 8)}),
  FIELD(StepReport, regularizations, FIELD_INT, "", .columns = {COLUMN(TABLE_TRUTH, "indef.", "systems", 8)}),
  FIELD(StepReport, systems, FIELD_INT, ""),
  FIELD(StepReport, filtered_systems, FIELD_INT, ""),
  FIELD(StepReport, linear, FIELD_RECORD, "", .record = &SchemaFallbacks),
  FIELD(StepReport, energy, FIELD_REAL, "force length",
    .columns = {COLUMN(TABLE_WORK, "energy", "", 15, .format = "%.8e", .blanks = 1),
      COLUMN(TABLE_BALANCE, "stored", "", 13, .format = "%.5e", .behind = PETSC_TRUE)}),
  FIELD(StepReport, plastic_work, FIELD_REAL, "force length",
    .columns = {COLUMN(TABLE_PLASTICITY, "plastic", "work", 13, .format = "%.5e")}),
  FIELD(StepReport, plastic_strain, FIELD_REAL, "",
    .columns = {COLUMN(TABLE_PLASTICITY, "largest", "plastic strain", 14, .format = "%.5e")}),
  FIELD(StepReport, work, FIELD_REAL, "force length",
    .columns = {COLUMN(TABLE_BALANCE, "work", "", 13, .format = "%.5e")}),
  FIELD(StepReport, dissipated, FIELD_REAL, "force length",
    .columns = {COLUMN(TABLE_BALANCE, "dissipated", "", 13, .format = "%.5e", .behind = PETSC_TRUE)}),
  FIELD(StepReport, contact_energy, FIELD_REAL, "force length"),
  FIELD(StepReport, contact_work, FIELD_REAL, "force length"),
  FIELD(StepReport, normal_work, FIELD_REAL, "force length",
    .columns = {COLUMN(TABLE_BALANCE, "normal forces", "", 13, .format = "%.5e", .behind = PETSC_TRUE)}),
  FIELD(StepReport, imbalance, FIELD_REAL, "", .absent = "-",
    .columns = {COLUMN(TABLE_BALANCE, "left", "", 8, .format = "%.3f %%", .shown = SHOWN_PERCENT,
      .behind = PETSC_TRUE)}),
  FIELD(StepReport, potential, FIELD_REAL, "force length",
    .columns = {COLUMN(TABLE_TRUTH, "potential", "", 15, .format = "%.8e", .blanks = 1)}),
  FIELD(StepReport, equilibrium, FIELD_REAL, "", .columns = {COLUMN(TABLE_TRUTH, "equilibrium", "residual", 11)}),
  FIELD(StepReport, kkt_error, FIELD_REAL, "", .columns = {COLUMN(TABLE_WORK, "KKT", "error", 9)}),
  FIELD(StepReport, kkt_error_unscaled, FIELD_REAL, "",
    .columns = {COLUMN(TABLE_TRUTH, "unscaled", "KKT error", 10, .behind = PETSC_TRUE)}),
  FIELD(StepReport, gap_min, FIELD_REAL, "length", .absent = "no contact",
    .columns = {COLUMN(TABLE_WORK, "smallest", "gap", 10)}),
  FIELD(StepReport, gap_true, FIELD_REAL, "length", .absent = "no contact",
    .columns = {COLUMN(TABLE_TRUTH, "true", "gap", 10, .behind = PETSC_TRUE)}),
  FIELD(StepReport, gap_change, FIELD_REAL, "length",
    .columns = {COLUMN(TABLE_TRUTH, "gap", "change", 10, .behind = PETSC_TRUE)}),
  FIELD(StepReport, normals_turn, FIELD_REAL, ""),
  FIELD(StepReport, slip_change, FIELD_REAL, "length"),
  FIELD(StepReport, gap_unconverged, FIELD_BOOL, ""),
  FIELD(StepReport, gap_damped, FIELD_INT, ""),
  FIELD(StepReport, complementarity, FIELD_REAL, "force/length",
    .columns = {COLUMN(TABLE_WORK, "complem.", "error", 9)}),
  FIELD(StepReport, action_reaction, FIELD_REAL, "", .columns = {COLUMN(TABLE_TRUTH, "action =", "reaction", 9)}),
  FIELD(StepReport, algebraic_error, FIELD_REAL, "",
    .columns = {COLUMN(TABLE_ERRORS, "", "of the solver", 13, .blanks = 1)}),
  FIELD(StepReport, error_estimate, FIELD_REAL, "", .absent = "",
    .columns = {COLUMN(TABLE_ERRORS, "", "of the mesh", 13, .shown = SHOWN_SQUARE),
      COLUMN(TABLE_ERRORS, "", "all", 10, .format = "%.3f %%", .shown = SHOWN_PERCENT, .blanks = 1)}),
  FIELD(StepReport, body_errors, FIELD_BODY_REALS, "",
    .columns = {COLUMN(TABLE_ERRORS, "", "", 10, .format = "%.3f %%", .shown = SHOWN_PERCENT)}),
  FIELD(StepReport, contact_force, FIELD_VECTOR, "force",
    .columns = {COLUMN(TABLE_FORCES, "contact force on the nonmortar side", "", -41, .blanks = 1)}),
  FIELD(StepReport, reaction, FIELD_VECTOR, "force",
    .columns = {COLUMN(TABLE_FORCES, "reaction on the driven faces", "", -41, .blanks = 1)}),
  FIELD(StepReport, ramps, FIELD_LIST, "", .count = offsetof(StepReport, nramps), .record = &SchemaRamps),
  FIELD(StepReport, pairs, FIELD_LIST, "", .count = offsetof(StepReport, npairs), .record = &SchemaPairs),
  FIELD(StepReport, faces, FIELD_LIST, "", .count = offsetof(StepReport, nfaces), .record = &SchemaFaces),
  FIELD(StepReport, connectors, FIELD_LIST, "", .count = offsetof(StepReport, nconnectors),
    .record = &SchemaConnectors),
  FIELD(StepReport, bolts, FIELD_LIST, "", .count = offsetof(StepReport, nbolts), .record = &SchemaBolts),
  FIELD(StepReport, rigid_bodies, FIELD_LIST, "", .count = offsetof(StepReport, nrigid_bodies), .record = &SchemaRigid),
  FIELD(StepReport, bodies, FIELD_LIST, "", .count = offsetof(StepReport, nbodies), .record = &SchemaBodies),
  FIELD(StepReport, motions, FIELD_LIST, "", .count = offsetof(StepReport, nmotions), .record = &SchemaMotions),
  FIELD(StepReport, balance, FIELD_REAL, "", .columns = {COLUMN(TABLE_FORCES, "balance", "", 9)}),
  FIELD(StepReport, weak_spring_force, FIELD_REAL, "force"),
  FIELD(StepReport, probes, FIELD_LIST, "", .count = offsetof(StepReport, nprobes), .record = &SchemaProbes),
  FIELD(StepReport, lines, FIELD_LIST, "", .count = offsetof(StepReport, nlines), .record = &SchemaLines),
  FIELD(StepReport, solve_time, FIELD_DOUBLE, "s"),
  FIELD(StepReport, step_time, FIELD_DOUBLE, "s"),
  FIELD(StepReport, converged, FIELD_BOOL, "", .absent = "not converged",
    .columns = {COLUMN(TABLE_WORK, "", "", 0, .blanks = 1)}),
  FIELD(StepReport, reason, FIELD_TEXT, ""),
  END,
};
const ReportRecord SchemaSteps = {sizeof(StepReport), PETSC_FALSE, step_fields};

static const ReportField time_fields[] = {
  FIELD(RunTimes, total, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "total", "", 0, .behind = PETSC_TRUE)}),
  FIELD(RunTimes, mesh, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "mesh", "", 0)}),
  FIELD(RunTimes, setup, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "set-up", "", 0)}),
  FIELD(RunTimes, assembly, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "assembly", "", 0)}),
  FIELD(RunTimes, contact_search, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "contact search", "", 0)}),
  FIELD(RunTimes, contact_integrals, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "contact gaps", "", 0)}),
  FIELD(RunTimes, contact, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "contact, else", "", 0)}),
  FIELD(RunTimes, amg_setup, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "AMG set-up", "", 0)}),
  FIELD(RunTimes, amg_apply, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "AMG apply", "", 0)}),
  FIELD(RunTimes, filter_setup, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "filter set-up", "", 0)}),
  FIELD(RunTimes, filter_apply, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "filter apply", "", 0)}),
  FIELD(RunTimes, directions, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "directions", "", 0)}),
  FIELD(RunTimes, reduced_factor, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "reduced factor", "", 0)}),
  FIELD(RunTimes, reduced, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "reduced, else", "", 0)}),
  FIELD(RunTimes, optimizer, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "optimizer, else", "", 0)}),
  FIELD(RunTimes, measures, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "measures", "", 0)}),
  FIELD(RunTimes, error_estimate, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "error estimate", "", 0)}),
  FIELD(RunTimes, results, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "results", "", 0)}),
  FIELD(RunTimes, comparison, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "without contact", "", 0)}),
  FIELD(RunTimes, other, FIELD_DOUBLE, "s", .columns = {COLUMN(TABLE_PHASES, "other", "", 0)}),
  END,
};
const ReportRecord SchemaTimes = {sizeof(RunTimes), PETSC_FALSE, time_fields};

static const ReportField level_fields[] = {
  FIELD(AccuracyLevel, refine, FIELD_INT, "", .columns = {COLUMN(TABLE_LEVELS, "refine", "", 8)}),
  FIELD(AccuracyLevel, dofs, FIELD_INT, "", .columns = {COLUMN(TABLE_LEVELS, "unknowns", "", 10)}),
  FIELD(AccuracyLevel, recovery, FIELD_REAL, "", .columns = {COLUMN(TABLE_LEVELS, "recovery", "", 10)}),
  FIELD(AccuracyLevel, change, FIELD_REAL, "", .absent = "-", .columns = {COLUMN(TABLE_LEVELS, "change", "", 10)}),
  FIELD(AccuracyLevel, error, FIELD_REAL, "", .columns = {COLUMN(TABLE_LEVELS, "mesh error", "", 12)}),
  FIELD(AccuracyLevel, unseen, FIELD_BOOL, "", .absent = "",
    .columns = {COLUMN(TABLE_LEVELS, "", "", 0, .format = "beyond recovery", .behind = PETSC_TRUE)}),
  FIELD(AccuracyLevel, algebraic, FIELD_REAL, "", .columns = {COLUMN(TABLE_LEVELS, "solver error", "", 12)}),
  FIELD(AccuracyLevel, amg_applications, FIELD_INT, "", .columns = {COLUMN(TABLE_LEVELS, "amg", "applic", 8)}),
  FIELD(AccuracyLevel, time, FIELD_DOUBLE, "s",
    .columns = {COLUMN(TABLE_LEVELS, "time", "", 10, .with_unit = PETSC_TRUE)}),
  END,
};
const ReportRecord SchemaLevels = {sizeof(AccuracyLevel), PETSC_TRUE, level_fields};

static const ReportField accuracy_fields[] = {
  FIELD(Accuracy, target, FIELD_REAL, ""),
  FIELD(Accuracy, share, FIELD_REAL, ""),
  FIELD(Accuracy, tolerance, FIELD_REAL, ""),
  FIELD(Accuracy, reached, FIELD_BOOL, ""),
  FIELD(Accuracy, end, FIELD_CHARS, ""),
  FIELD(Accuracy, levels, FIELD_LIST, "", .count = offsetof(Accuracy, nlevels), .record = &SchemaLevels),
  END,
};
static const ReportRecord SchemaAccuracy = {sizeof(Accuracy), PETSC_FALSE, accuracy_fields};

static const ReportField figure_fields[] = {
  FIELD(RunFigure, quantity, FIELD_TEXT, ""),
  FIELD(RunFigure, name, FIELD_TEXT, ""),
  FIELD(RunFigure, value, FIELD_REAL, ""),
  FIELD(RunFigure, unit, FIELD_CHARS, ""),
  FIELD(RunFigure, place, FIELD_VECTOR, "length"),
  FIELD(RunFigure, components, FIELD_VECTOR, "force"),
  FIELD(RunFigure, step, FIELD_INT, ""),
  END,
};
static const ReportRecord SchemaFigures = {sizeof(RunFigure), PETSC_TRUE, figure_fields};

static const ReportField contact_free_fields[] = {
  FIELD(RunContactFree, iterations, FIELD_INT, ""),
  FIELD(RunContactFree, condition, FIELD_REAL, ""),
  FIELD(RunContactFree, bound, FIELD_REAL, ""),
  FIELD(RunContactFree, solve_time, FIELD_DOUBLE, "s"),
  END,
};
static const ReportRecord SchemaContactFree = {sizeof(RunContactFree), PETSC_FALSE, contact_free_fields};

static const ReportField memory_fields[] = {
  FIELD(RunMemory, start, FIELD_DOUBLE, "byte"),
  FIELD(RunMemory, mesh, FIELD_DOUBLE, "byte"),
  FIELD(RunMemory, assembly, FIELD_DOUBLE, "byte"),
  END,
};
static const ReportRecord SchemaMemory = {sizeof(RunMemory), PETSC_FALSE, memory_fields};

static const ReportField run_fields[] = {
  FIELD(RunReport, problem, FIELD_TEXT, ""),
  FIELD(RunReport, units, FIELD_TEXT, ""),
  FIELD(RunReport, ranks, FIELD_INT, ""),
  FIELD(RunReport, dofs, FIELD_INT, ""),
  FIELD(RunReport, refine, FIELD_INT, ""),
  FIELD(RunReport, finite_strain, FIELD_BOOL, ""),
  FIELD(RunReport, converged, FIELD_BOOL, ""),
  FIELD(RunReport, reason, FIELD_TEXT, ""),
  FIELD(RunReport, exit_code, FIELD_INT, ""),
  FIELD(RunReport, warnings, FIELD_TEXTS, "", .count = offsetof(RunReport, nwarnings)),
  FIELD(RunReport, figures, FIELD_LIST, "", .count = offsetof(RunReport, nfigures), .record = &SchemaFigures),
  FIELD(RunReport, steps, FIELD_LIST, "", .count = offsetof(RunReport, nsteps), .record = &SchemaSteps),
  FIELD(RunReport, time, FIELD_RECORD, "", .record = &SchemaTimes),
  FIELD(RunReport, assemblies, FIELD_BODY_INTS, ""),
  FIELD(RunReport, accuracy, FIELD_POINTER, "", .record = &SchemaAccuracy),
  FIELD(RunReport, contact_free, FIELD_RECORD, "", .record = &SchemaContactFree),
  FIELD(RunReport, memory, FIELD_RECORD, "", .record = &SchemaMemory),
  FIELD(RunReport, peak_memory_bytes, FIELD_DOUBLE, "byte"),
  END,
};
const ReportRecord SchemaRun = {sizeof(RunReport), PETSC_FALSE, run_fields};

const void *SchemaAt(const ReportField *field, const void *record)
{
  return (const char *)record + field->offset;
}

/* Returns the value of a numeric or boolean field as a double; NaN for a field of another type. */
double SchemaNumber(const ReportField *field, const void *record)
{
  const void *value = SchemaAt(field, record);

  switch (field->type) {
  case FIELD_INT: return (double)*(const PetscInt *)value;
  case FIELD_REAL: return (double)*(const PetscReal *)value;
  case FIELD_DOUBLE: return *(const PetscLogDouble *)value;
  case FIELD_BOOL: return *(const PetscBool *)value ? 1.0 : 0.0;
  default: return NAN;
  }
}

const char *SchemaText(const ReportField *field, const void *record)
{
  const void *value = SchemaAt(field, record);

  return field->type == FIELD_CHARS ? (const char *)value : *(const char *const *)value;
}

/* Returns the number of values of a counted field. */
PetscInt SchemaCount(const ReportField *field, const void *record)
{
  return *(const PetscInt *)((const char *)record + field->count);
}
