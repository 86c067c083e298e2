# SPDX-License-Identifier: Apache-2.0
"""The bugs of the mutation run (mutate.py), by file: one line each, of the kind that people write.

  name       of the bug, by which it is told in reports; unique
  original   code that stands once in the file, or once in `context`, which then stands once in the file. A
             statement ends in ; and may be replaced by nothing. Anything else is an expression.
  mutated    what stands in its place
  breaks     what is wrong then
  tests      a regular expression: the tests that are likely to catch it; without it those of the file
  type       into which both expressions are converted, where they have none in common
  equivalent why no test can tell the two apart
"""

from collections import namedtuple

# The tests of a run: C++ by folder, and programs that drive the program from outside.
LABELS = ("solver", "corpus", "certify", "search", "reports")
PROGRAMS = ("attacks_test", "certificate_test", "existence_test", "false_claims_test", "formats_test", "latex_test", "outputs_test",
            "package_test", "paths_test", "problem_test", "replay_test", "safety_test", "solve_test", "store_test",
            "text_report_test", "usage_test", "viewer_data_test")

# Those of the Python package; what is installed of it is none of a copy of the sources.
PYTHON = ("arrays_test.py", "package_test.py", "refusal_test.py", "search_test.py")

Mutant = namedtuple("Mutant", "id file original mutated breaks tests context type equivalent")
MUTANTS = []


def in_file(file, likely):
    """Returns what adds a bug to the file, whose tests are likely to catch it."""
    def add(name, original, mutated, breaks, tests=None, context=None, type=None, equivalent=None):
        MUTANTS.append(Mutant(name, file, original, mutated, breaks, tests or likely, context, type, equivalent))
    return add


# ---- solver/published --------------------------------------------------------------

PUBLISHED = "^solver: (published|run|theorem|policies|frictionless)|^program: paths|^certify: policy classes"

bug = in_file("solver/published/published.ipp", PUBLISHED)
bug("normal-complementarity", "f >= 0 && a >= 0 && (f == 0 || a == 0)", "f >= 0 && a >= 0",
    "(15) without fN aN = 0",
    equivalent="fN = 0 outside of C and aN = 0 in C hold at every scan: a normal leaves C at fN = 0 only")
bug("friction-bound", "slack >= 0 && a * f <= 0 && (a == 0 || slack == 0)", "a * f <= 0 && (a == 0 || slack == 0)",
    "(16) without abs(fF) <= mu fN")
bug("friction-power", "slack >= 0 && a * f <= 0 && (a == 0 || slack == 0)", "slack >= 0 && (a == 0 || slack == 0)",
    "(16) without aF fF <= 0")
bug("friction-complementarity", "slack >= 0 && a * f <= 0 && (a == 0 || slack == 0)", "slack >= 0 && a * f <= 0",
    "(16) without aF (mu fN - abs(fF)) = 0")
bug("admit-not-read", "options_.policy.admit == Admit::kEager", "true", "admit=lazy is not honoured")
bug("file-not-read", "options_.policy.file == File::kNo", "false", "file=no is not honoured")
bug("file-at-rest", "Sign(state_.f[row - 1], scale_.force) > 0", "Sign(state_.f[row - 1], scale_.force) >= 0",
    "friction without a normal force is filed by sign")
bug("file-side", "a < 0 ? IndexSet::kAtUpper : a > 0 ? IndexSet::kAtLower : IndexSet::kSticking",
    "a > 0 ? IndexSet::kAtUpper : a < 0 ? IndexSet::kAtLower : IndexSet::kSticking", "filed at the wrong limit")
bug("file-no-touch", "if (!presses && state_.sets[row - 1] != IndexSet::kSeparating) continue;", "",
    "friction is suspended though its normal is in no set")
bug("rezero-not-read", "options_.policy.rezero == Rezero::kContinue", "true", "rezero=rescan is not honoured")
bug("suspended-not-filed", "FileBySign(driven + 1);", "", "a driven normal leaves its friction suspended")
bug("driven-wants-back", "step.limiting != driven && step.wants == last_left_[step.limiting]",
    "step.wants == last_left_[step.limiting]", "a driven friction that reaches zero can be given up")
bug("bounces-all", "statistics.bounces += wants_back && zero;", "statistics.bounces += wants_back;",
    "steps of positive length are counted as bounces")
bug("last-step-forgotten", "last_step_zero_ = zero;", "", "no step remembers that the one before had length zero")
bug("zero-run-goes-on", "zero_run_ = zero ? zero_run_ + 1 : 0;", "zero_run_ += zero;",
    "a run of zero steps does not end with a positive one")
bug("driven-friction-dropped", "friction == driven || state_.sets[friction] == IndexSet::kNone",
    "state_.sets[friction] == IndexSet::kNone", "the driven friction is dropped with its normal",
    equivalent="a driven variable is in no set until its drive ends, which the other condition says too")
bug("drop-not-read", "options_.policy.drop == Drop::kContact", "true", "drop=variable is not honoured")
bug("apex-not-read", "options_.policy.apex == Apex::kSuspended", "false", "apex=suspended is not honoured")
bug("closing-not-filed", "FileBySign(friction);", "", "a contact that closes leaves its friction suspended")
bug("outer-state-contact", "if (earlier.contact != contact) continue;", "",
    "resume=round: a state recurs though another contact was driven last")
bug("outer-state-forces", "earlier.sets != state_.sets || earlier.f != state_.f", "earlier.sets != state_.sets",
    "a state recurs though the forces are others")
bug("budget-drives", "verdict_.statistics.drives > limits.drives", "verdict_.statistics.drives >= limits.drives",
    "a budget of drives is one too small")
bug("budget-pivots", "verdict_.statistics.steps >= limits.pivots", "verdict_.statistics.steps > limits.pivots",
    "a budget of steps is one too large")
bug("give-up-not-consulted", "if (wants_back && zero != last_step_zero_) Consult(PolicySwitch::kGiveUp);", "",
    "policies are taken to run alike though they give up otherwise")
bug("overflow-solved", "if (!IsFinite()) return;", "", "infinite forces are called solved")
bug("most-violated-ties", "layout_.IsNormal(row) ? state_.a[row] < state_.a[other] : "
    "Abs(state_.a[row]) > Abs(state_.a[other])",
    "layout_.IsNormal(row) ? state_.a[row] <= state_.a[other] : Abs(state_.a[row]) >= Abs(state_.a[other])",
    "scan=most-violated takes the last of equal ones")

bug = in_file("solver/published/scan.h", PUBLISHED + "|^solver: space")
bug("round-from-the-first", "resume == Resume::kRound && last_driven >= 0",
    "resume == Resume::kRound && last_driven > 0", "resume=round forgets the first contact")
bug("normals-first-mixed", "frictions && layout.HasFriction(row) && violated(row + 1)",
    "layout.HasFriction(row) && violated(row + 1)", "scan=normals-first looks at frictions at once")
bug("highest-goes-up", "return PickInOrder(layout, true, true, first, contacts - 1, violated);",
    "return PickInOrder(layout, true, true, first, 1, violated);", "scan=highest goes upward")
bug("most-violated-friction-first", "normal >= 0 ? normal : friction", "friction >= 0 ? friction : normal",
    "scan=most-violated takes frictions before normals")
bug("give-up-second", "return zero && last_zero;", "return zero;", "give-up=second gives up at the first")
bug("give-up-previous", "return last_zero;", "return zero;", "give-up=previous looks at this step")

bug = in_file("solver/published/step_size.ipp", "^solver: (step size|run|published)|^program: paths")
bug("later-of-two-limits", "!(s < limit.s)", "s > limit.s", "of two limits at one step the second counts")
bug("bound-tolerance", "scale.pivot", "scale.rate", "driven friction: the tolerance of another unit",
    context="sign > 0 ? IndexSet::kAtUpper : IndexSet::kAtLower,\n        scale.pivot);")
bug("bound-rests", "Scalar(1 - mu * df[driven - 1])", "Scalar(1)", "driven friction: its bound does not move")
bug("last-of-a-set", "state.sets[row] < state.sets[first]", "state.sets[row] <= state.sets[first]",
    "of ties in a set the last limits")
bug("no-tie-tolerance", "limits_[nearest].s + scale.force", "limits_[nearest].s", "steps tie to the bit only",
    type="Scalar")
bug("driven-not-first", "if (within_reach(driven)) return driven;", "", "of ties the driven one is not the first")
bug("lower-bound-sign", "Scalar(-df[row] - growth)", "Scalar(-df[row] + growth)", "-mu fN moves the wrong way")
bug("rate-of-zero", "Sign(rate, tolerance) <= 0", "Sign(rate, tolerance) < 0", "a gap that rests is a limit")

# ---- solver/complete ---------------------------------------------------------------

COMPLETE = "^solver: (complete|space|equivalence|reduction|4.5)"

bug = in_file("solver/complete/complete.ipp", COMPLETE)
bug("up-or-level", "if (sign < 0) TraceStage(DrivenAmount());", "if (sign <= 0) TraceStage(DrivenAmount());",
    "a stage is entered without a sign")
bug("no-snap", "if constexpr (kMeetsLimits<Scalar>) Snap(reached.facet);", "", "the facet reached is not met exactly")
bug("folds-everywhere", "determinant * last_turn < 0", "determinant * last_turn <= 0", "every piece is a fold")
bug("ties-reversed", "if (order > 0) continue;", "if (order < 0) continue;", "of a tie the later one is taken")
bug("bilateral-ray-sign", "return Unlimited(-sign);", "return Unlimited(sign);", "the ray of bilateral contacts is turned")
bug("budget-pieces", "verdict_.statistics.pieces >= options_.limits.pivots",
    "verdict_.statistics.pieces > options_.limits.pivots", "a budget of pieces is one too large")
bug("pieces-bound", "of_stages = InSpace() ? cells : 3;", "of_stages = cells;", "the bound of the pieces is too large")
bug("descent-into-break", "if (cell.law == Law::kFree) TraceStage(StageEnd());", "TraceStage(StageEnd());",
    "a contact that broke is driven down")
bug("descent-corner", "sign > 0 ? 0 : 1", "sign > 0 ? 1 : 0", "a descent goes to the other side")
bug("dependent-bilateral", "SetCell(i, {Law::kHold, curvature > 0 ? 0 : 1});", "SetCell(i, {Law::kHold, 0});",
    "a dependent bilateral contact is an equation, too")

bug = in_file("solver/complete/complete_cells.ipp", COMPLETE)
bug("corner-side", "SignAt(at, {Kind::kOpposed, contact}) > 0 ? 0 : 1",
    "SignAt(at, {Kind::kOpposed, contact}) > 0 ? 1 : 0", "friction starts at the wrong limit")
bug("corner-in-space", "before < 0 && after > 0", "before < 0 || after > 0", "a corner that opposes one edge only")
bug("rest-sign", "return mu * f(0) - radius;", "return mu * f(0) + radius;", "a stage of friction in space has no end")
bug("lower-limit", "oriented(facet.k == 0, f[row + 1])", "oriented(facet.k != 0, f[row + 1])", "sides exchanged")

bug = in_file("solver/complete/complete_end.ipp", COMPLETE + "|^program: solve")
bug("residual-not-read", "!(Residual() <= tolerance)", "false", "whatever the residual, the answer is called solved")

bug = in_file("solver/complete/complete_ties.ipp", COMPLETE)
bug("sign-tolerance", "of_acceleration ? scale_.acceleration : scale_.force",
    "of_acceleration ? scale_.force : scale_.acceleration", "tolerances of another unit")
bug("normals-not-perturbed", "if (!IsBilateral(i)) normals += gradient[RowOf(i)];", "",
    "the perturbation does not press all contacts first")
bug("gradient-without-facet", "AddGradient(at, Scalar(-system.Solution(size)), gradient);", "",
    "the perturbation does not move the facet")

bug = in_file("solver/complete/polygon.h", "^solver: (polygon|space)|^certify: space")
bug("corner-twice", "Sign(Cross(corners_[k], corner)) <= 0", "Sign(Cross(corners_[k], corner)) < 0",
    "a corner that is there is added again")
bug("beyond-the-edge", "if (along > radius) along = radius;", "", "points are projected beyond an edge")

bug = in_file("solver/complete/polygon_errors.h", "^solver: (space|polygon)|^certify: (space|lemke)")
bug("polygon-without-slip", "Scalar(at.f[0] - at.r * at.a[0])", "at.f[0]", "friction on a polygon need not oppose the slip")

# ---- solver/lemke ------------------------------------------------------------------

bug = in_file("solver/lemke/lemke.ipp", "^solver: (lemke|equivalence)|^certify: (lemke|existence)|^program: existence")
bug("first-row-tie", "Sign(Entry(T_(i, 0) * cover_[best] - T_(best, 0) * cover_[i])) <= 0",
    "Sign(Entry(T_(i, 0) * cover_[best] - T_(best, 0) * cover_[i])) < 0", "the first pivot is not lexicographic")
bug("artificial-stays", "CompareQuotients(artificial, best, 0) <= 0 ? artificial : best",
    "CompareQuotients(artificial, best, 0) < 0 ? artificial : best", "z0 does not leave when it can")
bug("multiplier-sign", "z.block == Block::kNormal ? problem_->contacts[w.contact].mu : Scalar(-1)",
    "z.block == Block::kNormal ? problem_->contacts[w.contact].mu : Scalar(1)", "friction widens its limit")
bug("lemke-budget", "verdict_.statistics.pivots >= options_.limits.pivots",
    "verdict_.statistics.pivots > options_.limits.pivots", "a budget of pivots is one too large")
bug("corner-force-sign", "f[z.row] -= value;", "f[z.row] += value;", "friction the other way has the same sign")
bug("lemke-residual-not-read", "errors.Largest() > residual_tolerance_", "false", "any answer over doubles is solved")
bug("lemke-first-pivot", "pivot < 0", "pivot < -1", "the denominator is negative after z0 came in")
bug("lemke-ray-unit", "if (entering < size_) change *= row_units_[entering];", "",
    "a direction is per unit of the scaled row")
bug("lemke-value-unit", "variable < size_ ? Entry(denominator_ * row_units_[variable]) : denominator_", "denominator_",
    "an acceleration is told in units of its scaled row")
bug("lemke-bits", "MayExceedBits(i) && BitLength<Scalar>::Of(Value(i)) > options_.limits.bits", "MayExceedBits(i)",
    "bits are counted before common factors are found")
bug("lemke-order", "if (const int order = CompareQuotients(i, k, c); order != 0) return order < 0;",
    "if (const int order = CompareQuotients(i, k, c); order != 0) return order > 0;", "the largest quotient leaves")

# ---- solver/linear -----------------------------------------------------------------

LINEAR = "^solver: (direction|elimination|updated|inverse|dense|fast|null vector|complete|published)|^certify: (properties|safe)"

bug = in_file("solver/linear/elimination.ipp", LINEAR)
bug("first-pivot", "best < 0 || Abs(M_(i, column)) > Abs(M_(best, column))", "best < 0",
    "over doubles any entry is a pivot")
bug("swaps-not-counted", "odd_swaps_ = !odd_swaps_;", "", "the sign of a determinant forgets exchanges of rows")
bug("singular-determinant", "if (rank_ < rows_) return Scalar(0);", "", "a singular matrix has another determinant")
bug("orientation-parity", "odd_swaps_ ? -last : last", "last", "the sign of a minor forgets exchanges of rows")
bug("back-substitution", "for (int k = i + 1; k < rank_; ++k) x -= M_(i, pivot_column_[k]) * x_[pivot_column_[k]];",
    "for (int k = i + 2; k < rank_; ++k) x -= M_(i, pivot_column_[k]) * x_[pivot_column_[k]];",
    "an unknown is left out of the equation above")

bug = in_file("solver/linear/direction.ipp", LINEAR + "|^solver: space")
bug("null-vector-parity", "if ((rank - free) % 2 != 0) sign = -sign;", "", "a null vector has the wrong sign")
bug("forces-inconsistent", "if (!system.IsConsistent(size, scale.rate)) return Status::kInconsistent;", "",
    "forces that do not exist are returned")

bug = in_file("solver/linear/inverse.h", LINEAR)
bug("inverse-sign", "if (s < 0) sign_ = -sign_;", "", "updates forget the sign of the determinant")
bug("any-pivot", "Abs(s) > sqrt(std::numeric_limits<Scalar>::epsilon()) * entries", "std::abs(s) > 0",
    "updates divide by rounding errors")

bug = in_file("solver/linear/updated_system.ipp", LINEAR)
bug("residual-accepted", "residual <= 64 * kEpsilon * unit", "true", "directions are accepted whatever their residual")

bug = in_file("solver/linear/dense_factor.h", LINEAR)
bug("bennett", "alpha *= from[j] / d;", "", "removal of a row updates the factors with the wrong weight")
bug("dependent-appended", "!(schur > tolerance * diagonal)", "false", "a dependent column is appended")

bug = in_file("solver/linear/unknowns.h", LINEAR + "|^solver: run")
bug("lower-limit-column", "entry -= along;", "entry += along;", "NC- is taken for NC+")

# ---- solver/problem ----------------------------------------------------------------

ERRORS = "^solver: (errors|gate|coulomb|fast|space)|^certify: solve|^solve:"

bug = in_file("solver/problem/units.h", ERRORS)
bug("units-of-a-jam", "acceleration_[i] = free + std::min(sum_[i], bound);", "acceleration_[i] = free + sum_[i];",
    "forces that do no work make units large")
bug("work-of-errors", "Abs(work.free) + std::max(Scalar(0), work.sliding)", "Abs(work.done)", "the work of a wrong acceleration softens its own verdict")
bug("work-not-rounded", "Scalar(std::min(Abs(work.done), given) - work.error)", "Scalar(std::min(Abs(work.done), given))", "the rounding of a jam counts as work")
bug("groups-one", "contact_of_[i] == contact_of_[j] || x == 0", "contact_of_[i] == contact_of_[j]",
    "bodies far apart see each other's work")

bug = in_file("solver/problem/errors.h", ERRORS)
bug("negative-limit", "limit_ = Limit(mu_, std::max(Scalar(0), fN_));", "limit_ = mu_ * fN_;",
    "a pull makes the limit of friction negative")
bug("separates-with-friction", "open.force = std::max(open.force, InUnits(Length(fF_[0], fF_[1]), friction_.force));", "",
    "a contact that separates may have friction")
bug("sticks-while-moving", "error.acceleration = std::max(error.acceleration, InUnits(speed, friction_.acceleration));", "",
    "a contact that sticks may slip")
bug("beyond-the-limit", "error.force = std::max(error.force, InUnits(gap.excess, friction_unit_));", "",
    "a contact that sticks has any friction")
bug("infinite-units", "unit > 0 && x < Infinity<Scalar>()", "unit > 0", "infinite mu hides what is missed",
    equivalent="an infinite distance is met in infinite units only where a contact sticks as well")
bug("weak-power", "along <= 0 ? Abs(Scalar(force - limit)) : Length(along, Scalar(across - limit)) + force * turn",
    "Abs(Scalar(force - limit))", "(21) without fF.aF <= 0")

bug = in_file("solver/problem/gate.h", ERRORS)
bug("rounding-not-bounded", "Units<long double>::Rounding(problem.rows())", "0.0L",
    "the errors are not upper bounds")

bug = in_file("solver/problem/row_scale.h", ERRORS)
bug("scale-of-contacts", "ExponentOf(largest[uniform ? 0 : groups.ContactOf(i)]) >> 1", "ExponentOf(largest[0]) >> 1",
    "contacts have no units of their own")


bug = in_file("solver/problem/state.h", "^solver: (step size|run|published|complete)")
bug("force-tolerance-unit", "scale.force = std::max(Scalar(tolerances.force), least) * f;",
    "scale.force = std::max(Scalar(tolerances.force), least) * a;", "the tolerance of forces is one of accelerations")

bug = in_file("solver/problem/reduction.ipp", "^solver: (4.5|6:|bilateral|a singular|in space|doubles)|^certify: runs")
bug("sliding-sign", "-contact.mu * contact.slip[i - 1]", "contact.mu * contact.slip[i - 1]",
    "sliding friction pushes along", type="Scalar")
bug("bilateral-contradiction", "if (Sign(b[row], zero_acceleration) != 0) return ReductionEnd::kInconsistent;", "",
    "bilateral contacts that contradict each other are reduced")
bug("bilateral-constant", "x0[determines[i]] = -T(i, kept + count);", "x0[determines[i]] = T(i, kept + count);",
    "bilateral forces push the wrong way")

# ---- certify: the checker ------------------------------------------------------------

CHECKER = "^program: false_claims|^certify: certificate"

bug = in_file("certify/claims/solution.cpp", CHECKER)
bug("claim-coulomb-above-one", "bound <= 0 || bound > 1", "bound <= 0", "coulomb-solution: a bound above 1")
bug("claim-coulomb-negative", "bound <= 0 || bound > 1", "bound > 1", "coulomb-solution: a bound of zero or less")
bug("claim-accelerations", 'RequireEqual(a[i], answer[i], fmt::format("witness.a[{}]", i));', "",
    "solution-exists: any a")

bug = in_file("certify/claims/matrix.cpp", CHECKER)
bug("claim-symmetric", """throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second), "an entry unlike its mirror",
                   "A = A'"};""", "", "every A is symmetric")
bug("claim-not-symmetric", 'if (problem.A(i, j) == problem.A(j, i)) throw Rejected{"witness", "A_ij = A_ji", '
    '"different entries"};', "", "no A is symmetric")
bug("claim-psd-negative", "D[i] < 0", "false", "psd: D may be negative")
bug("claim-psd-product", "rest(i, j) -= L(i, k) * rest(j, k)", "rest(i, j) -= L(i, k) * L(j, k)",
    "psd: the product lacks D")
bug("claim-psd-column", 'RequireEqual(rest(i, k), L(i, k) * D[k], fmt::format("(A - L diag(D) L\')[{}][{}]", i, k));', "",
    "psd: any L and D")
bug("claim-psd-triangle", 'RequireEqual(L(i, j), i == j ? 1 : 0, fmt::format("witness.L[{}][{}]", i, j));', "",
    "psd: L of any form")
bug("claim-not-psd-zero", "curvature >= 0", "curvature > 0", "not-psd: x'Ax = 0 will do")
bug("claim-not-psd-value", 'RequireEqual(ReadNumber(witness["value"], "witness.value"), curvature, "witness.value");',
    "", "not-psd: any value")
bug("claim-in-range", 'RequireEqual(image[i], problem.b[i], fmt::format("(A x)[{}]", i));', "", "in-range: any x")
bug("claim-not-in-range-transpose", "problem.A.transpose() * y", "problem.A * y", "not-in-range: A y for A'y",
    type="ExactVector")
bug("claim-not-in-range-zero", """if (product == 0) throw Rejected{"witness.value", "0", "y'b /= 0"};""", "",
    "not-in-range: y'b = 0 will do")
bug("claim-not-in-range-kernel", """RequireEqual(image[j], 0, fmt::format("(y'A)[{}]", j));""", "",
    "not-in-range: y'A may be anything")
bug("claim-not-in-range-value", 'RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");',
    "", "not-in-range: any value", context='''RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product == 0)''')
bug("claim-definite", "D[i] <= 0", "D[i] < 0", "definite: semidefinite is enough")
bug("claim-not-definite-zero", 'if (x.isZero()) throw Rejected{"witness.x", "0", "another vector"};', "",
    "not-definite: by x = 0")
bug("claim-not-definite", "curvature > 0", "curvature > 1", "not-definite: x'Ax up to 1")

bug = in_file("certify/claims/hypothesis.cpp", CHECKER)
bug("claim-h-sliding", "HasSlidingContact(problem)", "false", "h, not-h: sliding contacts, too",
    context="if (HasSlidingContact(problem)) {\n    throw Rejected{")
bug("claim-h-cone", """throw Rejected{"b - A'y", *violation, "a vector of the dual cone"};""", "", "h: any y")
bug("claim-exists-psd", "RequireFactors(problem, witness);", "", "exists: any A",
    context="RequireFactors(problem, witness);\n  RequireHypothesis(problem, witness);")
bug("claim-exists-h", "RequireHypothesis(problem, witness);", "", "exists: any b",
    context="RequireFactors(problem, witness);\n  RequireHypothesis(problem, witness);")
bug("claim-not-h-cone", 'if (const auto violation = FindConeViolation(problem, v)) throw Rejected{"witness.v", '
    '*violation, "v in K"};', "", "not-h: v outside of K")
bug("claim-not-h-kernel", 'RequireEqual(image[i], 0, fmt::format("(A v)[{}]", i));', "", "not-h: A v may be anything")
bug("claim-not-h-zero", "product >= 0", "product > 0", "not-h: b'v = 0 will do")
bug("claim-not-h-value", 'RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");', "",
    "not-h: any value", context='''RequireEqual(ReadNumber(witness["value"], "witness.value"), product, "witness.value");
  if (product >= 0)''')

bug = in_file("certify/claims/cycle.cpp", CHECKER)
bug("claim-cycle-dimension", 'if (problem.dimension != 2) throw Rejected{"problem.dimension", "3", "2: this claim is checked '
    'in the plane"};', "", "cycle: of problems in space, too")
bug("claim-cycle-length", 'RequireSame(stated["pivots"].size(), run.trace.pivots.size(), path + ".pivots: number");', "",
    "cycle: any number of steps")
bug("claim-cycle-start", 'RequireSame(ReadInteger(stated["start"], path + ".start", 0), run.verdict.start, path + ".start");',
    "",     "cycle: any start")
bug("claim-cycle-state", 'RequireEqual(f[i], run.state.f[i], ElementPath(path + ".f", i));', "",
    "cycle: any forces recur")
bug("claim-cycle-policy-twice", 'throw Rejected{where, Shown(named[p]), "each policy once"};', "",
    "cycle: a policy counts twice")
bug("claim-cycle-of-space", 'if (policy.slip != Slip{}) throw Rejected{path, Shown(json), "a policy of the planar grid"};',
    "", "cycle: policies of space count")
bug("claim-cycle-spelling", "if (PolicyName(policy) != name) throw Rejected{path, Shown(json), PolicyName(policy)};", "",
    "cycle: a policy has several names")
bug("claim-cycle-run-twice", "p == 0 && !different.insert(StepsAsText(run, names)).second", "false",
    "cycle: a run counts twice")
bug("claim-counterexample-solution", "RequireSolution(problem, witness);", "", "counterexample: any f",
    context="RequireSolution(problem, witness);\n  return CheckRuns(problem, witness);")

bug = in_file("certify/claims/certificate.cpp", CHECKER)
bug("certificate-digest", "!digest.empty() && report.digest != digest", "false", "check --problem: any problem")
bug("certificate-rows", "rows <= kMostRowsOfCertificate", "true", "any number of rows", tests="^program: limits")
bug("certificate-digits", "digits <= kMostDigitsOfCertificate", "true", "numbers of any length", tests="^program: limits")
bug("certificate-version", '!certificate["version"].is_number_integer() || certificate["version"] != 1',
    'certificate["version"] != 1', "version 1.0 is read")
bug("certificate-format", 'certificate["format"] != "stiction-certificate"', "false", "any format is read")
bug = in_file("certify/claims/witness.cpp", "^program: limits")
bug("work-operations", "operations <= static_cast<double>(kMostOperations)", "true", "any number of operations")
bug("work-bits", "bits_ <= most_", "true", "operations on numbers of any length")
bug("work-one-bit", "bits_ <= most_", "bits_ < most_", "a bit less than the other checkers take")

bug = in_file("certify/exact/verify_solution.cpp", CHECKER + "|^certify: (verify|space|coulomb)|^solver: run")
bug("planar-complementarity", 'if (product != 0) return Broken(contact, "fN aN = 0", product);', "", "(15) without fN aN = 0")
bug("planar-acceleration", 'if (a < 0) return Broken(contact, "aN >= 0", a);', "", "(15) without aN >= 0")
bug("planar-force", 'if (f < 0) return Broken(contact, "fN >= 0", f);', "", "(15) without fN >= 0")
bug("planar-bound", 'if (slack < 0) return Broken(contact, "abs(fF) <= mu fN", slack);', "", "(16) without its bound")
bug("planar-power", 'if (power > 0) return Broken(contact, "aF fF <= 0", power);', "", "(16) without aF fF <= 0")
bug("planar-slip", 'if (product != 0) return Broken(contact, "aF (mu fN - abs(fF)) = 0", product);', "",
    "(16) without slip at the limit only")
bug("bilateral-rest", "a[row] == 0", "a[row] >= 0", "a bilateral contact may open")
bug("sliding-side", "f[row + 1] + bound * law.slip[0]", "f[row + 1] - bound * law.slip[0]",
    "sliding friction pushes along", type="Rational")
bug("space-bound", 'if (slack < 0) return Broken(c.number, "fF.fF <= mu^2 fN^2", slack);', "", "in space: no bound")
bug("space-power", 'if (c.Power() > 0) return Broken(c.number, "fF.aF <= 0", c.Power());', "", "(21) without fF.aF <= 0")
bug("space-slip", 'if (product != 0) return Broken(c.number, "aF = 0 or abs(fF) = mu fN", product);', "",
    "(21) without slip at the limit only")
bug("space-second-tangent", "return f_x * f_x + f_y * f_y;", "return f_x * f_x;", "friction of one tangent only")
bug("coulomb-angle", 'if (excess < 0) return Broken(c.number, "(fF.aF)^2 >= c^2 mu^2 fN^2 aF.aF", excess);', "",
    "Coulomb's law at any angle")
bug("space-sliding-y", "Rational(c.f_y + c.Bound() * c.law.slip[1])", "Rational(0)", "sliding friction along x only")

bug = in_file("certify/exact/farkas.cpp", CHECKER + "|^certify: (no-solution|modes)")
bug("break-friction", "return yN >= 0 && yF == 0;", "return yN >= 0;", "break: yF may be anything")
bug("break-normal", "return yN >= 0 && yF == 0;", "return yF == 0;", "break: yN may be anything")
bug("touch-slip", "gN - SlipOf(contact) * along <= 0 && yF == 0", "gN + SlipOf(contact) * along <= 0 && yF == 0",
    "touch: sliding friction the other way")
bug("touch-friction", "gN - SlipOf(contact) * along <= 0 && yF == 0", "gN - SlipOf(contact) * along <= 0",
    "touch: yF may be anything")
bug("stick-one-side", "return gN + abs(along) <= 0;", "return gN + along <= 0;", "stick: one side of the cone")
bug("slip-plus-friction", "return gN - along <= 0 && yF >= 0;", "return gN - along <= 0;", "slip+: yF may be anything")
bug("slip-plus-side", "return gN - along <= 0 && yF >= 0;", "return gN + along <= 0 && yF >= 0;", "slip+: the other edge")
bug("slip-minus-side", "return gN + along <= 0 && yF <= 0;", "return gN - along <= 0 && yF <= 0;", "slip-: the other edge")
bug("hold-side", "return gN == 0;", "return gN <= 0;", "hold: bilateral contacts only push")
bug("touch-in-space-second-tangent", "y[row + 1] != 0 || y[row + 2] != 0", "y[row + 1] != 0",
    "in space: yF of the second tangent may be anything")
bug("break-in-space", "if (mode == kBreak) return y[row] >= 0;", "if (mode == kBreak) return true;",
    "in space, break: yN may be anything")
bug("touch-in-space-opposite", "g[row] <= 0 && contact.mu * contact.mu * square <= g[row] * g[row]",
    "contact.mu * contact.mu * square <= g[row] * g[row]", "in space, touch: a dual cone and its opposite")
bug("touch-in-space-length", "g[row + 1] * g[row + 1] + g[row + 2] * g[row + 2]", "g[row + 1] * g[row + 1]",
    "in space, touch: the second tangent does not count", type="Rational")
bug("touch-in-space-slip", "contact.slip[0] * g[row + 1] + contact.slip[1] * g[row + 2]",
    "contact.slip[0] * g[row + 1] - contact.slip[1] * g[row + 2]", "in space: a sliding contact slides another way",
    type="Rational")
bug("refutation-of-zero", "farkas.value >= 0", "farkas.value > 0", "y'b = 0 refutes")
bug = in_file("certify/claims/no_solution.cpp", CHECKER + "|^certify: (no-solution|modes)")
bug("prefix-twice", 'if (listed.size() < prefixes.size()) throw Rejected{path, "a prefix twice", "each once"};', "",
    "a prefix counts twice")
bug("prefix-extension", 'throw Rejected{ElementPath(path, k) + ".modes", "an extension of another prefix", "none"};', "",
    "a prefix and its extensions count")
bug("cover-less", "covered != words", "covered > words", "words may be left out")

bug = in_file("certify/exact/hypothesis.cpp", CHECKER + r"|^certify: \(H\)")
bug("dual-bilateral", 'if (contact.kind == ContactKind::kBilateral && g[row] != 0) return Broken(i, "gN = 0", g[row]);', "",
    "bilateral contacts have the dual cone of others")
bug("dual-normal", 'if (g[row] < 0) return Broken(i, "gN >= 0", g[row]);', "", "a dual cone and its opposite")
bug("dual-friction", 'if (slack < 0) return Broken(i, "gN^2 - (mu gF)^2 >= 0", slack);', "", "dual cones without friction")
bug("cone-friction", 'if (slack < 0) return Broken(i, "(mu vN)^2 - vF^2 >= 0", slack);', "", "cones of any friction")
bug("cone-normal", "contact.kind != ContactKind::kBilateral && v[row] < 0", "false", "cones that pull")
bug("cone-bilateral", "contact.kind != ContactKind::kBilateral && v[row] < 0", "v[row] < 0", "bilateral contacts only push")
bug("second-tangent", "for (int k = 1; k < dimension; ++k) square += x[row + k] * x[row + k];",
    "for (int k = 1; k < 2; ++k) square += x[row + k] * x[row + k];", "the second tangent does not count")
bug("dual-transpose", "rest[j] -= y[i] * problem.A(i, j);", "rest[j] -= y[i] * problem.A(j, i);", "A y for A'y")

bug = in_file("certify/exact/modes.cpp", CHECKER)
bug("modes-in-space", "dimension == 2 && HasFrictionModes(contact)", "HasFrictionModes(contact)",
    "contacts in space have the modes of the plane")

IN_SPACE = r"^certify: (space|rest|\(H\))"
bug = in_file("certify/claims/refute_in_space.cpp", IN_SPACE)
bug("open-word", "result_.end = EnumerationEnd::kOpen;", "", "a word that nothing refutes is refuted")
bug("refuted-touch", "i < prefix.size() && prefix[i] == Mode::kTouch", "i < prefix.size()",
    "contacts that break are in touch")
bug = in_file("certify/exact/cones.cpp", IN_SPACE)
bug("added-corner-side", "which == EdgesOf::kAroundCone ? 1 : -1", "which == EdgesOf::kAroundCone ? -1 : 1",
    "corners are added opposite to where they are wanted")
bug("corner-length", "dual ? mu * mu * length <= normal : length <= mu * mu * normal",
    "dual ? length <= mu * mu * normal : length <= mu * mu * normal", "a cone is its dual cone")
bug = in_file("certify/exact/rest.cpp", IN_SPACE)
bug("rest-sliding", "if (HasSlidingContact(problem)) return std::nullopt;", "", "contacts that slide rest")
bug("rest-without-programs", "IsRegular(problem.A)", "true", "at rest by one vector or not at all")
bug = in_file("certify/exact/solve.cpp", IN_SPACE + "|^program: solve")
bug("moves-elsewhere", "answer.moves_elsewhere = true;", "", "that accelerations are not unique is not told")

bug = in_file("certify/claims/safe.cpp", CHECKER + "|^certify: safe")
bug("safe-of-zero", 'if (determinant <= 0) throw Rejected{path, ToString(determinant), "a number > 0"};',
    'if (determinant < 0) throw Rejected{path, ToString(determinant), "a number > 0"};', "a determinant of zero is safe")
bug("unsafe-positive", 'if (value > 0) throw Rejected{"witness.determinant", ToString(value), "a number <= 0"};', "",
    "a positive determinant is unsafe")
bug("determinant-stated", "if (value == determinant) return determinant;", "return determinant;", "any number is stated")
bug("slip-factor", "if (mode == kSlipPlus) return -contact.mu;", "if (mode == kSlipPlus) return contact.mu;",
    "both slips have one determinant")
bug("weakly-safe", "sign < 0 && !safety.negative_word", "sign <= 0 && !safety.negative_word",
    "weakly safe: a determinant of zero is negative")
bug("limit-sign", "*first < 0", "*first > 0", "safe in the limit: the other sign")
bug("pivot-of-zero", "pivot <= 0", "pivot < 0", "the search divides by zero")
bug("short-word", 'RequireList(stated, "witness.word", problem.contacts.size(), "modes");', "", "a word of fewer modes")
bug("safe-of-other-kinds", "if (PublishedHandles(problem)) return;", "return;", "safe: sliding and bilateral contacts")

bug = in_file("certify/claims/condition.cpp", CHECKER + "|^certify: condition")
bug("scaling-sign", 'if (d[i] <= 0) throw Rejected{ElementPath("witness.scaling", i), ToString(d[i]), "a number > 0"};', "",
    "scalings may be negative")
bug("condition-least", "!IsSemidefinite(B - least * I)", "false", "any least eigenvalue")
bug("condition-most", "!IsSemidefinite(most * I - B)", "false", "any largest eigenvalue")
bug("condition-equality", "friction * friction * gap * gap < 4 * least * most",
    "friction * friction * gap * gap <= 4 * least * most", "equality is safe")
bug("condition-asymmetric", '''throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second),
                   ToString(problem.A(pair->first, pair->second)),
                   ToString(problem.A(pair->second, pair->first)) + ", as across the diagonal"};''', "",
    "A need not be symmetric")
bug("ratio-upside-down", "largest = std::max(largest, Rational(weight * d[row - 1] / d[row]));",
    "largest = std::max(largest, Rational(weight * d[row] / d[row - 1]));", "m upside down")
bug("ratio-last", "largest = std::max(largest, Rational(weight * d[row - 1] / d[row]));",
    "largest = Rational(weight * d[row - 1] / d[row]);", "the friction of the last contact alone")

bug = in_file("certify/claims/witness.cpp", CHECKER)
bug("unknown-keys", 'if (!keys.contains(key)) throw Rejected{path + "." + key, "an unknown key", expected};', "",
    "unknown keys are passed over")
bug("least-integer", "json.is_number_integer() && json.get<std::int64_t>() >= least", "json.is_number_integer()",
    "indices may be negative")

# ---- certify: deciding ---------------------------------------------------------------

bug = in_file("certify/exact/enumerate.cpp", "^certify: (modes|no-solution|agreement)|^program: existence")
bug("tight-everywhere", "if (value != 0) continue;", "", "every condition is tight")
bug("only-solution-rank", "if (Rank(normals, static_cast<int>(variables)) < static_cast<int>(variables)) return false;", "",
    "a continuum is called one solution")
bug("first-not-read", "if (options_.first_solution_only) result_.end = EnumerationEnd::kFirstSolution;", "",
    "the first solution does not end the search")
bug("programs-budget", "result_.programs == options_.programs", "result_.programs > options_.programs",
    "a budget of programs is one too large")
bug("enumerate-cancel", "if (!options_.progress(progress)) result_.end = EnumerationEnd::kCancelled;",
    "options_.progress(progress);", "the search cannot be cancelled")
bug("tight-direction", "for (mpz_class& coefficient : normals.back()) coefficient = -coefficient;", "",
    "an upper limit is a lower one")

bug = in_file("certify/exact/modes.cpp", "^certify: (modes|agreement|no-solution)")
bug("slip-edge", "return {{{-mu}}, Relation::kZero, Relation::kAtLeastZero};",
    "return {{{mu}}, Relation::kZero, Relation::kAtLeastZero};", "slip+ pushes along")
bug("stick-anywhere", "return abs(f[row + 1]) <= contact.mu * f[row];", "return true;", "sticking with any force")

bug = in_file("certify/exact/exact.cpp", "^certify: (runs|exact|policy classes|variables|certificate)|^program: paths")
bug("contact-not-restored", "state.last_driven_contact = remainder.ContactOf(state.last_driven_contact);", "",
    "the contact driven last is told in numbers of the reduced problem")
bug("classes-too-wide", "!AgreeOn(known.consulted, known.policies.front(), policy)", "false",
    "one run speaks for all policies")

bug = in_file("certify/claims/agreement.cpp", "^certify: agreement|^search: (unit|alarms)")
bug("another-solution-listed", "(!solution.unique || solution.f == f)", "true", "any force in a mode is its solution")
bug("lemke-need-not-solve", 'answer.method == "complete" || answer.method == "lemke"', 'answer.method == "complete"',
    "Lemke's method may end anyhow")
bug("own-tie", "if (row == pivot.limiting) continue;", "", "every step has a tie")
bug("regular-on-boundary", "modes.distinct_witnesses == count.words", "true", "solutions on a boundary are regular")
bug("incomplete-counts", "!answers.modes || answers.modes->end != EnumerationEnd::kComplete", "!answers.modes",
    "an enumeration that was stopped claims to be complete")

bug = in_file("certify/exact/slope.h", "^certify: (slope|robust)")
bug("slope-of-a-product", "x.range_ * t + y.centre_ * s", "x.centre_ * t + y.centre_ * s", "a slope at the centre alone")
bug("slope-of-a-quotient", "s - quotient * t", "s", "a denominator that does not change")

bug = in_file("certify/claims/robust_scene.cpp", "^certify: robust")
bug("contact-not-moved", "Number(point[1]) + Off(reach_)", "Number(point[1])", "heights are known exactly")
bug("rows-not-independent", "Unsure<Slope>::TellsSign(determinant) && !IsSurelyZero(determinant)", "true",
    "any three rows hold a body")
bug("gravity-between-bodies", "if (bodies_[contact.a].fixed == bodies_[contact.b].fixed) return {};", "",
    "gravity accelerates bodies that fall together relative to each other")

bug = in_file("certify/claims/safety_threshold.cpp", "^certify: safe")
bug("sturm-variations", "sign * last < 0", "sign * last <= 0", "roots that are none")
bug("threshold-of-the-last", "if (smallest && !IsSmaller(root, *smallest)) continue;", "", "not the smallest root")

bug = in_file("certify/exact/properties.cpp", "^certify: (semidefinite|range|symmetry|assumptions|certificate)")
bug("curvature-witness", "y[k] = -(S(i, i) + 1) / (2 * S(i, k));", "y[k] = (S(i, i) + 1) / (2 * S(i, k));",
    "a direction of positive curvature")
bug("range-obstacle", "M(i, size) != 0", "M(i, size) > 0", "an obstacle of one sign only")

# ---- certified signs ---------------------------------------------------------------

FILTERED = "^certify: (balls|filtered)|^search: (unit|alarms)"

bug = in_file("solver/problem/ball.h", FILTERED)
bug("ball-sum-unrounded", "x.radius_ + y.radius_ + Round::OfSum(x.middle_, y.middle_, sum)", "x.radius_ + y.radius_",
    "sums do not round")
bug("ball-product-unrounded", "x.IsZero() || y.IsZero() ? 0 : Round::OfProduct(product)", "0.0", "products do not round")
bug("ball-product-radius", "x.Size() * y.radius_ + x.radius_ * (y.Size() + y.radius_)", "x.Size() * y.radius_ + x.radius_ * y.Size()",
    "the product of the radii is forgotten")
bug("ball-least", "kUnit * std::abs(product) + kLeast", "kUnit * std::abs(product)", "products below all doubles are exact")
bug("ball-quotient-of-unsure", "if (!(least > 0)) throw UnsureSign();", "", "what may be zero divides")
bug("ball-quotient-radius", "x.radius_ + (Round::Size(quotient) + rounding) * y.radius_ + Rounding<double>::kLeast",
    "x.radius_ + Rounding<double>::kLeast", "the divisor is known")
bug("ball-zero-lost", "if (x.IsZero()) return {};", "", "zero over anything is no longer known to be zero")
bug("ball-sign-of-zero", "if (!IsZero()) throw UnsureSign();", "", "an unsure sign is zero")
bug("ball-earliest", "(gap.Size() - gap.radius()) / (rate.Size() + rate.radius())", "gap.Size() / rate.Size()",
    "an unsure limit is later than it may be")

bug = in_file("certify/exact/filtered.cpp", FILTERED)
bug("no-second-rung", "Rung::kDoubleDouble <= rungs.last", "false", "double-doubles are never asked")
bug("rungs-beyond-last", "rungs.last != Rung::kExact", "false", "rationals are asked where they were not wanted")
bug("complete-upper-lower", "Mode::kSlipMinus", "Mode::kSlipPlus",
    "the last word slides the wrong way, and rationals must help", context="return Mode::kSlipMinus;  // fF = mu fN")
bug("no-dependent-rows", "TryPublished<dd_real>(remaining, options, &dependent)", "TryPublished<dd_real>(remaining, options, nullptr)",
    "zeros of singular matrices are unsure")

bug = in_file("certify/exact/dependent_rows.cpp", FILTERED)
bug("dependent-without-b", "row << problem_.A.row(i), problem_.b[i];", "row << problem_.A.row(i), Rational(0);", "equations between rows of A alone",
    equivalent="of the generators b is in the range of A, where the same equations hold for b")


# ---- search --------------------------------------------------------------------------

bug = in_file("search/units/unit.cpp", "^search: (unit|alarms)")
bug("wrong-answer-threshold", "!(error() <= kWrongAnswer)", "!(error() <= 1)", "wrong is above 1, not 1e-6")
bug("misjudged-not-counted", "tally.misjudged += misjudged;", "", "misjudged runs are not counted")
bug("misjudged-stratum-not-counted", "stratum.misjudged += misjudged;", "", "misjudged runs are not counted by friction and rank")
bug("exact-stratum-not-counted", "++stratum.exact[static_cast<int>(exact)];", "", "exact outcomes are not counted by friction and rank")
bug("loop-words-unkept", "!loop.named", "loop.named", "words are kept where the signature has one",
    context="if (!loop.named) result_.record.words")
bug("grave-when-full", "if (full && !IsGrave(kind)) return;", "if (full) return;", "a full unit drops grave findings")
bug("wrong-solution-counted", "tally.solved += complete.Solved() && !wrong;", "tally.solved += outcome == Outcome::kSolved;",
    "wrong solutions are counted as solved")
bug("certified-undrawn", "!suspected || IsDrawn(DrawOf(place.index))", "!suspected",
    "no certified suspicion is drawn for other methods")
bug("unsure-believed", "drawn || !certified", "drawn",
    "where a sign is unsure, rationals are not asked")
bug("unconfirmed", "if (verdict.outcome != Outcome::kSolved) Confirm(place, problem, filtered);", "",
    "what certified signs do not solve is no finding")
bug("filtered-uncompared", "if (filtered != nullptr) CompareFiltered(place, *filtered, run, problem);", "",
    "filtered runs are not held against rationals")
bug("certified-unaudited", "audit || (exact && suspected)", "exact && suspected", "certified runs are not audited")
bug("safety-without-switch", "policy.apex = Apex::kSuspended;", "", "the check of safe problems lacks its switch")
bug("wrong-not-suspected", "!solved || wrong", "!solved", "wrong answers raise no suspicion")
bug("audited-not-counted", "++tally.audited;", "", "audits are not counted")
bug("wrong-not-counted", "collector.tally(policy).wrong += wrong;", "", "wrong answers are not counted")
bug("of-rounded", "if (!Row(task_.generator).exact_in_double || Row(task_.generator).HasOtherKinds()) return;", "",
    "a rounded problem's answer or outcome is a finding")
bug("undecided-misjudged", "if (exact == Outcome::kUndecided) return;", "",
    "what intervals cannot decide counts against doubles")
bug("space-existence-unasked", "if (!wrong && complete.outcome != Outcome::kRay) return;", "return;",
    "no solution in space is no finding")
bug("space-undecided-dropped", "inexact.outcome == Outcome::kCycle", "false",
    "loops that intervals do not prove are no findings")
bug("safe-cycle-missed", "outcome == Outcome::kCycle && IsSafe(problem)", "false",
    "cycles of safe problems are cycles like others")
bug("ties-not-excused", "if (HasTies(problem, run)) return;", "", "safe problems with ties are findings")
bug("give-ups-not-read", "if (run.verdict.statistics.give_ups == 0) return;", "", "every safe problem gives up")
bug("disagreements-not-counted", "++result_.record.agreement[task_.contacts].disagreements;", "",
    "disagreements are not counted")
bug("signs-of-irregular", "count.regular && count.signs != 1", "count.signs != 1", "signs are counted of all problems")
bug("safety-of-suspicions", "if (!suspected && !Row(task_.generator).HasOtherKinds()) CheckSafety(place, run, problem);",
    "if (!Row(task_.generator).HasOtherKinds()) CheckSafety(place, run, problem);",
    "safety is checked of suspicions, too")
bug("audit-once", "if (audit) until_audit = campaign.audit_every;", "until_audit = campaign.audit_every;",
    "only the first problem is audited")
bug("one-too-many", "static_cast<std::int64_t>(result_.candidates.size()) >= campaign_.representatives_per_unit",
    "static_cast<std::int64_t>(result_.candidates.size()) > campaign_.representatives_per_unit",
    "one representative too many")
bug("lemke-on-audits-only", "with_lemke || IsOneIn(draw, campaign_.lemke_every)", "with_lemke",
    "suspicions are never run by Lemke's method")
bug("safety-of-fewer", "if (task_.contacts > kMostContactsEnumerated) return;",
    "if (task_.contacts >= kMostContactsEnumerated) return;", "the largest problems are not checked")
bug("policy-not-named", 'if (!(policy == Policy{})) signature += "@" + PolicyName(policy);', "",
    "findings of all policies share a signature")

bug = in_file("search/lanes/run_lanes.ipp", "^search: batch")
bug("lanes-reach", "~(limits[row].s > reach)", "~(limits[row].s > nearest)",
    "in lanes steps within the tolerance do not tie")
bug("lanes-tie", "place[i] < at", "at < place[i]", "of equal pivots in lanes the last is taken")
bug("lanes-singular", "singular_directions_ += Select(driving_ & singular, All(1), All(0));", "",
    "singular directions are not counted in lanes")
bug("lanes-inconsistent", "Leave(driving_ & inconsistent);", "", "lanes go on where a direction system has no solution")
bug("lanes-infinite", "Leave(driving_ & ~(sum <= __DBL_MAX__));", "", "lanes go on with numbers that are not finite")
bug("lanes-power", "~along", "~(along & ~along)", "lanes take friction that pushes for one that holds",
    context="return ~(slack < -force_tolerance_) & ~along & (~(a_positive | a_negative) | ~(slack > force_tolerance_));")
bug("lanes-second-limit", "second.exists & ~(first.exists & ~(second.s < first.s))", "second.exists & ~first.exists",
    "in lanes the second limit of a friction never comes first")
bug("lanes-give-up", "Leave(moves & ~is_driven_[row] & (wants_ == last_left_[row]) & zero);", "",
    "what is given up does not leave the lanes")
bug = in_file("search/units/finish.cpp", "^search: finish")
bug("safe-once-minimized", 'if (outcome == Outcome::kCycle && facts["minimized"]["safe"] == true) finding.kind = kSafeCycle;',
    "", "a cycle that is safe once minimized is one like others")
bug("methods-not-compared", "if (!cancelled()) CompareMethods(finished, facts, found, limits);", "",
    "methods are not compared when a finding is finished")
bug("disagreement-minimized", "found.run.verdict.outcome != Outcome::kSolved && finished.kind != kDisagreementOfMethods",
    "found.run.verdict.outcome != Outcome::kSolved", "a disagreement is minimized away")
bug("signature-not-kept", "if (IsLoop(run.verdict.outcome)) options.signature = Signature(problem, run);", "",
    "minimizing may lead to another loop")
bug("grid-not-certified", "whole ? PlanarGrid() : std::vector<Policy>{policy}", "std::vector<Policy>{policy}",
    "a loop of the whole grid is certified under one policy", type="std::vector<Policy>")
bug("grid-not-kept", "whole_grid", "false", "minimizing may lose policies",
    context="if (whole_grid) {\n    options.policies = PlanarGrid();")
bug("cancelled-is-done", "if (cancelled()) return std::nullopt;", "", "what was cancelled is called done")

bug = in_file("search/units/minimize.cpp", "^search: (minimize|simplicity|finish)")
bug("asymmetric-kept", 'if (!IsSymmetric(candidate)) return "A is not symmetric";', "", "A need not stay symmetric")
bug("indefinite-kept", 'if (!IsPositiveSemidefinite(candidate)) return "A is not positive semidefinite";', "",
    "A need not stay semidefinite")
bug("out-of-range-kept", 'if (!IsInRange(candidate)) return "b is not in range(A)";', "", "b need not stay in range(A)")
bug("another-loop-kept", '''if (options_.signature && Signature(candidate, run) != *options_.signature)
      return "it has another signature";''', "", "the loop may become another")
bug("policies-lost", "!AllEndIn(options_.keep, candidate, options_.policies, options_.limits)", "false",
    "policies may end otherwise")
bug("mirror-not-set", "candidate.A(j, i) = number;", "", "one of two mirrored entries is simplified")
bug("friction-row-kept", "if (k != contact) rows.push_back(row);", "rows.push_back(row);",
    "a contact without friction keeps its row")

bug = in_file("search/units/signature.cpp", "^search: (signature|unit|finish)")
bug("tangents-not-turned", 'sign * turn > 0 ? "+" : "-"', 'sign > 0 ? "+" : "-"', "a turned tangent is another loop")
bug("period-too-long", "pivots[k].drive > verdict.start", "pivots[k].drive >= verdict.start", "a drive before the period")
bug("no-word-of-two", "contacts.size() <= kMostContactsWithWord", "contacts.size() < kMostContactsWithWord",
    "loops of two contacts have no word")
bug("all-steps-zero", "step.s == 0", "step.s >= 0", "words do not tell zero steps from others")

bug = in_file("search/campaign.cpp", "^search: campaign")
bug("units-too-small", "campaign.unit_problems >> std::max(0, task.contacts - 2)",
    "campaign.unit_problems >> std::max(0, task.contacts - 1)", "units of two contacts are half as large")
bug("a-unit-too-many", "if (rest <= 0) break;", "if (rest < 0) break;", "a unit too many")
bug("large-denominators", "mu->get_num() <= kLargestMuPart && mu->get_den() <= kLargestMuPart",
    "mu->get_num() <= kLargestMuPart", "friction of any denominator")
bug("a-round-too-many", "if (round >= WeightOf(contacts)) continue;", "if (round > WeightOf(contacts)) continue;",
    "sizes come once too often")
bug("policy-twice", "std::find(policies.begin(), here, *here) != here", "false", "a policy may stand twice")
bug = in_file("corpus/record/fields.ipp", "^search: campaign")
bug("definition-of-all", "if (field.use != use) continue;", "", "what is kept apart stands in the definition too")

# ---- corpus --------------------------------------------------------------------------

bug = in_file("corpus/record/counts.cpp", "^search: summary|^reports: ")
bug("all-confirmed", "(inexact == outcome ? confirmed : doubles_differ) += count;", "confirmed += count;",
    "every suspicion is confirmed")
bug("undecided-differs", "if (outcome == static_cast<int>(Outcome::kUndecided)) continue;", "",
    "what is undecided counts as a difference of doubles")
bug("misjudged-not-summed", "misjudged += tally.misjudged;", "", "misjudged runs are not told")
bug("problems-per-policy", "most = std::max(most, tally.problems);", "most += tally.problems;",
    "problems count once for every policy")
bug = in_file("corpus/record/counts.h", "^reports: ")
bug("stalls-are-no-loops", "Of(Outcome::kCycle) + Of(Outcome::kStall)", "Of(Outcome::kCycle)", "stalls are no loops")
bug = in_file("corpus/store/store_totals.cpp", "^search: summary|^reports: text")
bug("grave-not-named", "if (IsGrave(finding.kind)) totals.grave.push_back(finding);", "", "grave findings are not named")
bug("grid-of-any-size", "totals.whole_grid += grid.size() == 1;", "totals.whole_grid += 1;",
    "every loop is one of the whole grid")

bug = in_file("corpus/intervals.cpp", "^intervals: ")
bug("ends-vanish", "alike(interval.low, digits) || alike(interval.high, digits)", "false",
    "the ends of a narrow interval are shown as its value")
bug("series-of-many", "if (n > 1e9) return OfManyEvents(n);", "", "intervals of many events throw")

bug = in_file("corpus/store/store.cpp", "^corpus: (store|merge)|^program: store")
bug("largest-represents", "now <= std::pair(candidate.unit, candidate.index)", "now >= std::pair(candidate.unit, candidate.index)",
    "the largest problem represents its group")
bug("block-too-early", "CountUnits(shard, block) < kUnitsPerBlock", "CountUnits(shard, block) < kUnitsPerBlock - 1",
    "a block closes one unit too early")
bug("finish-overwrites", "if (present.Step()) WriteFinding(db_.get(), finding);", "WriteFinding(db_.get(), finding);",
    "what was replaced meanwhile is finished all the same")
bug("any-campaign", "*stored == identity", "true", "another campaign's store is taken")
bug("any-file", "head != kMagic", "false", "a file that is no database is taken over")
bug("blocks-of-all-shards", "shard.Owns(unit) && blocks.contains(BlockOf(shard, unit))", "blocks.contains(BlockOf(shard, unit))",
    "a block of one shard has the units of others")
bug("foreign-database", "tables.Integer(0) > 0 && tables.Integer(1) == 0", "false", "another database is taken over")
bug("pages-unchecked", 'check.Text(0) != "ok"', "false", "pages that do not fit together are believed")
bug("store-replaced", "RENAME_NOREPLACE", "0", "a store that came meanwhile is overwritten")
bug("store-beside-link", "S_ISREG(status.st_mode) && status.st_nlink == 1", "true",
    "what SQLite writes beside a store goes where a second name leads", tests="^program: links")
bug("campaign-unsealed", "seal != stored", "false", "a campaign that was changed is believed",
    context="if (const std::string seal = CampaignSeal(values); seal != stored) {")

bug = in_file("corpus/store/store_rows.cpp", "^corpus: (store|merge|work)")
bug("row-unsealed", "seal != stored", "false", "a row that was changed is believed", context="  if (seal != stored) {")
bug("seal-without-lengths", 'fmt::format("{}:{}\\n", column.size(), column)', "column", "columns may change places in a seal")
bug("machines-unwritten", "!work.machines.empty()", "false", "a store does not name the machines that searched")

bug = in_file("corpus/record/work.h", "^corpus: (store|merge|work)")
bug("machines-of-one-part", "machines.insert(other.machines.begin(), other.machines.end());", "void();",
    "of two parts of a campaign the machines of one are named")

bug = in_file("corpus/store/store_merge.cpp", "^corpus: (store|merge|work)")
bug("merge-overwrites", "if (mine <= std::tuple(finding.unit, finding.index, -static_cast<std::int64_t>(finding.done))) return;",
    "", "the other store's findings win")
bug("merge-any-campaign", "other.identity_ != identity_", "false", "stores of different campaigns are merged",
    context="""void Store::MergeFrom(const Store& other) {
  if (other.identity_ != identity_) {""")
bug("merge-twice", "if (HoldsIn(db, unit, shards)) RefuseTwice(unit);", "", "a unit counts for two shards")
bug("merge-twice-alone", "RefuseTwice(alone.Integer(0));", ";", "a unit alone and in a block counts for two shards")
bug("merge-unheld", "HoldsIn(db_.get(), unit, shards)", "false", "a unit of a block is taken in once more")
bug("salvage-unsound", "RequireSoundRow(other.db_.get(), table, row);", "", "damaged rows are saved")
bug("work-added", "work.Unite(ReadWorkRow(row));", "work.Add(ReadWorkRow(row));", "a merge with itself doubles the time")

bug = in_file("search/units/backlog.cpp", "^search: backlog")
bug("no-bound", "size >= *most_", "false", "the backlog has no bound")
bug("grave-waits-not", "IsGrave(finding.kind)", "false", "a grave finding may be left out",
    context="!IsGrave(finding.kind) && !finding.done")
bug("outdated-back", "admitted->second.unit != entry.finding.unit", "false", "what was replaced meanwhile waits again")

bug = in_file("search/units/finishing_time.h", "^search: finishing")
bug("for-ever", "std::max(left, kAfterLastUnit - finishing)", "kNoBound", "after the last unit finishing has no end")
bug("share-without-try", "left >= 0 ? left + one_try : 0", "left", "a finding longer than the share is never finished")

bug = in_file("corpus/record/problem_file.cpp", "^corpus: (problem|formats)")
bug("entry-twice", 'if (!A.emplace(std::pair(i, j), Number(entry[2])).second) entry.Refuse("each entry once");',
    "A.emplace(std::pair(i, j), Number(entry[2]));", "an entry may stand twice")
bug("entry-above", 'if (is_new && i < j) entries[k].Refuse("an entry above the diagonal only beside the one below");', "",
    "entries above the diagonal are mirrored")
bug("negative-mu", 'if (mu < 0) place.Refuse("mu >= 0");', "", "friction may be negative")
bug("slip-not-unit", "if (!IsUnit(slip)) place.Refuse(expected);", "", "slip need not be a unit vector")
bug("not-mirrored", "A.emplace(std::pair(j, i), A.at({i, j})).second", "false",
    "entries below the diagonal have no mirror")
bug("strict-numbers", "if (!strict || json.is_string()) x = ExactValue(json);", "x = ExactValue(json);",
    "certificates may have JSON numbers")
bug("misplaced-mu", 'if (mu && !contact.HasFrictionRows()) mu->Refuse("no mu on a " + name + " contact");', "",
    "mu on frictionless contacts")
bug("rounded-integers", "return IsExactDouble(x) ? std::optional(x) : std::nullopt;", "return std::optional(x);",
    "integers that others round are read")
bug("sparse-asymmetric", "A == A.transpose()", "true", "half of an asymmetric matrix is written")
bug("expect-twice", "!is_new", "false", "a policy may be expected twice")

FOREIGN = "^corpus: (Siconos|FCLIB)|^program: formats"

bug = in_file("corpus/formats/siconos.cpp", FOREIGN)
bug("numbers-behind", "words.ExpectEnd();", "", "numbers behind the last one are a remark: other kinds are misread")

bug = in_file("corpus/formats/siconos_words.cpp", FOREIGN)
bug("flag-any-number", 'numbers == 1 && (first == "0" || first == "1")', "numbers == 1", "any one number is a flag")
bug("matrix-a-remark", 'if (word == "CSparse") Refuse("another matrix", expected);', "",
    "the second matrix of a global problem is a remark")

bug = in_file("corpus/formats/siconos_kinds.cpp", FOREIGN)
bug("plasticity-in-two", 'words.Integer("dimension", 3, 6)', 'words.Integer("dimension", 2, 6)',
    "a planar contact in csparse is called plasticity")
bug("relay-without-bounds", "words.SkipNumbers(3 * n);", "words.SkipNumbers(2 * n);", "a relay problem is not told")

bug = in_file("corpus/formats/fclib.cpp", FOREIGN)
bug("two-problems", "problems.size() > 1", "false", "the first of two problems is read")

bug = in_file("corpus/rational.cpp", "^corpus: (rational|nearest|bits)")
bug("ties-up", "half > 0 || (half == 0 && quotient % 2 != 0)", "half >= 0", "halves are rounded up")
bug("subnormal-bit", "-1074L", "-1073L", "the last bit of subnormals is lost")
bug("exponent-limit", "exponent > kMaxExponent", "exponent >= kMaxExponent", "an exponent of 10000 is refused")
bug("overflow-early", "static_cast<long>(BitLength<Integer>::Of(digits)) + last_bit > 1024",
    "static_cast<long>(BitLength<Integer>::Of(digits)) + last_bit > 1023", "the largest doubles are infinite")
bug("binary-exponent", "below ? e - 1 : e", "e", "numbers are rounded to one bit less")
bug("zero-denominator", "if (denominator == 0) return std::nullopt;", "", "a denominator of zero is read")
bug("empty-fraction", "if (fraction.empty()) return std::nullopt;", "", "1. is a number")

bug = in_file("corpus/record/statistics.cpp", "^corpus: (record|tally|store|merge)")
bug("misjudged-not-merged", "misjudged += other.misjudged;", "", "misjudged runs are lost in sums",
    context="misjudged += other.misjudged;\n  for (std::size_t i = 0; i < rungs.size(); ++i)")
bug("stratum-misjudged-not-merged", "misjudged += other.misjudged;", "", "misjudged runs of a stratum are lost in sums",
    context="misjudged += other.misjudged;\n  AddTo(outcomes, other.outcomes);")
bug("zero-steps-not-merged", "AddTo(loops[contacts].by_zero_steps, tally.by_zero_steps);", "",
    "loops by zero steps are lost in sums")
bug("sketch-never-full", "if (hashes_.size() > kMost) hashes_.pop_back();", "", "a sketch keeps all words")
bug("words-not-merged", "AddTo(mine.words, tally.words);", "", "mode words are lost in sums")

bug = in_file("corpus/record/statistics.h", "^corpus: (record|tally)|^search: unit")
bug("maxima-add", "mine = std::max(mine, theirs);", "mine += theirs;", "maxima are sums")
bug("give-ups-counted", "with_give_ups += s.give_ups > 0;", "with_give_ups += s.give_ups;", "give-ups for runs with any")

bug = in_file("corpus/atomic_file.cpp", "^corpus: (atomic|whole)|^program: outputs")
bug("mode-lost", "if (stat(target.c_str(), &old) == 0) fchmod(out_.number(), old.st_mode & 07777);", "",
    "a file that is replaced loses its mode")
bug("link-replaced", "Followed(file)", "file", "a link is replaced by a file", type="fs::path",
    context="const fs::path target = Followed(file);")
bug("new-through-link", "O_CREAT | O_EXCL | O_NOFOLLOW", "O_CREAT", "a file is written through a link that was planted",
    tests="^program: links|^corpus: whole")
bug("input-for-output", "if (is_path) throw InputError(refused.what());", "", "a wrong path is a full disk")

bug = in_file("corpus/whole_folder.cpp", "^program: links|^corpus: whole")
bug("folder-of-others", "S_ISREG(StatusOf(folder / kList).st_mode)", "true", "a folder of somebody else is emptied")
bug("folder-link", "O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC", "O_RDONLY | O_DIRECTORY | O_CLOEXEC",
    "the folder that a link leads to is locked", equivalent="what is no folder itself is refused by its status, too")

bug = in_file("corpus/store/store_lock.cpp", "^program: links|^corpus: store lock")
bug("lock-link", "O_RDWR | O_CREAT | O_NOFOLLOW", "O_RDWR | O_CREAT", "a lock is written through a link")
bug("lock-name", "status.st_nlink <= 1", "true", "a lock is written into a file with another name")

bug = in_file("corpus/formats/fclib.cpp", "^corpus: formats")
bug("fclib-bytes", "bytes_ <= most", "true", "a small file takes any memory")

# ---- reports -------------------------------------------------------------------------

bug = in_file("reports/tables/table.cpp", "^reports: ")
bug("quote-not-quoted", r'text.find_first_of(",\"\r\n") == std::string_view::npos',
    r'text.find_first_of(",\r\n") == std::string_view::npos', "a cell with a quotation mark breaks its row")
bug("quote-not-doubled", r'''c == '"' ? std::string("\"\"") : std::string(1, c)''', "std::string(1, c)",
    "quotation marks end their cell")
bug("interval-of-the-runs", "CountInterval(ratio.count)", "CountInterval(ratio.of)",
    "the interval of a rate is that of another count")
bug("control-not-replaced", "static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c", "c",
    "control characters of a store come through", type="char")
bug("small-first", "return *x < *y;", "return *x > *y;", "friction coefficients stand the wrong way round")
bug("pivot-shifted", "keys + static_cast<std::size_t>(place)", "keys", "what stands across stands in one column")

bug = in_file("reports/tables/campaign_tables.cpp", "^reports: ")
bug("last-bin", "{steps, steps == Tally::kBins - 1, g.tally.steps[steps]}", "{steps, false, g.tally.steps[steps]}",
    "the last bin is like others")
bug("empty-bins-drawn", "if (g.tally.steps[steps] == 0) continue;", "", "bars of no height are drawn")
bug("wrong-confirmed", "inexact == kSolvedOutcome ? -1 : inexact", "inexact", "wrong answers are confirmed by right ones")
bug("refuted-by-cycles", "refuted = c.Of(Outcome::kSolved);", "refuted = c.Of(Outcome::kCycle);",
    "confirmed cycles are called refuted")
bug("exceptions-hidden", "Exception(e.problems - e.solved)", "Exception(0)", "unsolved problems are not told")
bug("disagreements-hidden", "Exception(a.disagreements)", "Exception(0)", "disagreements are not told")
bug("wrong-is-solved", "g.tally.outcomes[kSolvedOutcome] - g.tally.wrong", "g.tally.outcomes[kSolvedOutcome]",
    "wrong answers of doubles count as solutions")
bug("lemke-disagrees", "tally.compared - tally.disagreements", "tally.compared", "a disagreement counts as solved")

bug = in_file("reports/tables/discovery.cpp", "^reports: ")
bug("some-loop", "loops > 0 && loops == Total()", "loops > 0", "every policy loops if one does")
bug("longest-loop", "rank(discovery) < rank(*simplest)", "rank(discovery) > rank(*simplest)",
    "the page features the longest problem")
bug("unrepresented", "if (discovery.representative != nullptr) sorted.push_back(&discovery);",
    "sorted.push_back(&discovery);", "groups without a representative are shown")
bug("file-names-collide", "if (name == signature && !name.empty()) return name;", "return name;",
    "two signatures have one file")

bug = in_file("reports/report_files.cpp", "^reports: ")
bug("certificate-of-the-original", "own.empty() ? finding.certificate : own", "finding.certificate",
    "the minimized problem has the certificate of another")

bug = in_file("reports/page/found_section.cpp", "^reports: ")
bug("counted-is-pending", "pending += discovery.representative != nullptr && !discovery.Finished();",
    "pending += !discovery.Finished();", "groups that are only counted are pending")

bug = in_file("reports/page/frontiers.cpp", "^reports: measured")
bug("records-of-any-size", "line.objective == best.objective && line.name.ends_with(end)", "line.objective == best.objective",
    "the best of four contacts stands beside a record of three")
bug("nothing-reached-is-zero", "if (value.empty()) return {};", "if (value.empty()) return 0;",
    "where random problems reached nothing a ring is drawn at zero")

bug = in_file("reports/page/measured_page.cpp", "^reports: measured")
bug("remedy-is-an-arithmetic", "line.arithmetic.substr(0, line.arithmetic.find(' '))", "line.arithmetic",
    "double with a remedy counts as an arithmetic")
bug("filtered-is-rounded", 'line.arithmetic == "exact" || line.arithmetic == "filtered"', 'line.arithmetic == "exact"',
    "what certified signs decide counts as rounded")

bug = in_file("reports/page/rungs.cpp", "^reports: rungs")
bug("silent-beyond-wrong", "line.silent > line.wrong", "false", "more silent answers than wrong ones are read")

bug = in_file("reports/animation.cpp", "^reports: (animation|draw)")
bug("animation-side", "ShownSide(scene, force.bodies) == 0 ? 1 : -1", "1", "forces point into the body that moves")
bug("animation-of-joints", "if (!force.from_joint) forces.push_back(ForceJson(moved, screen, force, newton));",
    "forces.push_back(ForceJson(moved, screen, force, newton));", "forces of joints are shown as if of contacts")

bug = in_file("reports/html/html.cpp", "^reports: ")
bug("markup-in-text", 'out += "&lt;";', "out += '<';", "text of a store can be markup")
bug("markup-in-script", "c == '<'", "c == '>'", "script data can end a script or begin a comment")

bug = in_file("corpus/plain_text.cpp", "^reports: ")
bug("shell-quote", r"""c == '\'' ? std::string("'\\''") : std::string(1, c)""", "std::string(1, c)",
    "a policy can end its shell word")

bug = in_file("reports/tables/since.cpp", "^reports: ")
bug("since-always-more", "discovery.met > before->second.met", "discovery.met >= before->second.met",
    "what is as it was is told as news")
bug("since-gone-hidden", "if (present.count(signature) > 0) continue;", "continue;", "what is gone is not told")

bug = in_file("reports/report.cpp", "^reports: ")
bug("files-by-interest", "d == simplest", "false",
    "the simplest loop, which the page shows, has no files")
bug("one-file-more", "static_cast<std::int64_t>(kept.size()) < most", "static_cast<std::int64_t>(kept.size()) <= most",
    "one finding more has files")

bug = in_file("reports/page/sentences.cpp", "^reports: ")
bug("all-solved", 'all.solved == all.problems', "true", "problems that were not solved are not told",
    context='all.solved == all.problems ? "Solutions')

bug = in_file("reports/html/template.cpp", "^reports: ")
bug("mark-twice", "page.find(mark, at + 1) == page.npos", "true", "a mark that stands twice is filled once")

bug = in_file("reports/text/text_report.cpp", "^reports: text")
bug("known-is-new", "known_as(signature).empty()", "true", "loops of the corpus are new ones")
bug("grave-at-the-end", "GraveLines(t) + RemarkLines(store.identity()) + Findings(t)",
    "RemarkLines(store.identity()) + Findings(t) + GraveLines(t)", "grave findings are not named first")

bug = in_file("reports/comparison/exact_tests.cpp", "^reports: comparison")
bug("one-sided", "weight <= seen * kSame ? weight : 0", "weight < seen ? weight : 0", "the table seen does not count")
bug("bonferroni", "order.size() - k", "order.size()", "every p is corrected for all tests")

bug = in_file("reports/comparison/comparison.cpp", "^reports: comparison")
bug("misjudged-of-all", "ShareOf(c.misjudged, c.audited)", "ShareOf(c.misjudged, c.runs)",
    "misjudged runs are held against all runs")
bug("median-of-half", "if (2 * up_to >= all) return steps;", "if (up_to >= all) return steps;", "the median is the most")
bug("one-rank", "frictions[key.friction].Add(stratum);", "(frictions[key.friction] = Counts()).Add(stratum);",
    "a friction has one rank alone")
bug("shards-compared", "a.identity() == b.identity()", "false", "stores of one campaign are compared")
bug("rates-the-wrong-way", "return ValueOf(rate.a) > ValueOf(rate.b);", "return ValueOf(rate.a) < ValueOf(rate.b);",
    "more is said to be less")

bug = in_file("reports/papers/latex.cpp", "^reports: latex|^program: latex")
bug("interval-as-reach", "scale * (count - interval.low)", "scale * interval.low", "error bars begin at the interval's end")

bug = in_file("reports/papers/package.cpp", "^program: package")
bug("certificate-of-another", "of_original ? files.original : files.problem", "files.original",
    "a certificate is said to be of the problem as found")

# ---- cli ---------------------------------------------------------------------------

VIEWER = "^program: viewer_data"

bug = in_file("cli/narration/narrate_baraff.cpp", "^program: replay")
bug("mark-late", "(ended == answer_.start)", "(ended == answer_.start + 1)", "the state that recurs is marked a drive late")
bug("mark-inside", "ended == Ended(steps - 1)", "false", "every step of a drive is marked")

bug = in_file("cli/narration/outcome_text.cpp", "^program: replay")
bug("all-rounded", "text.size() <= kLong", "text.size() <= 2", "short fractions are rounded, too")
bug("none-rounded", "fractions == FractionText::kFull", "true", "long fractions stand in full")

bug = in_file("cli/words.cpp", "^program: replay")
bug("part-of-a-word", "belongs(text[end])", "false", "drive is found in driven")

bug = in_file("cli/live/live.cpp", "^program: live")
bug("live-reading", "RequireReading(problem, request);", "", "a page runs readings that are not built in space")

bug = in_file("cli/replay.cpp", "^program: problem")
bug("nothing-in-common", "of_some == values(grid)", "true", "what policies share is not told")

bug = in_file("cli/solve.cpp", "^program: replay")
bug("bound-untold", 'if (result.contains("bound")) return WithinText(result);', "", "friction up to a bound is called exact")

bug = in_file("certify/claims/claims.cpp", "^program: (usage|certificate|existence)")
bug("claims-in-space", "problem.dimension != 2", "false", "loops are claimed of problems in space")
bug("claims-of-any-kind", "kind == ContactKind::kFrictionless || kind == ContactKind::kStatic", "true",
    "safety is claimed of sliding contacts")

bug = in_file("cli/narration/partings.cpp", VIEWER)
bug("parting-without-sets", "left.sets == right.sets", "true", "runs that differ in their sets part a step late")
bug("parting-own-value", "value == row.get(policy)", "false", "a run is compared with itself alone",
    equivalent="a run that is compared with itself parts nowhere")
bug("parting-at-the-end", "step < both", "true", "a run that is the same is said to part")

bug = in_file("cli/narration/replay_page.cpp", VIEWER)
bug("loop-from", 'pivots[from]["drive"] <= replay["start"]', 'pivots[from]["drive"] < replay["start"]',
    "the state that stands again is marked a drive early")
bug("reading-of-friction", "row.id != PolicySwitch::kDrop || !on_normal", "row.id != PolicySwitch::kDrop",
    "a friction variable is said to take something along")

bug = in_file("cli/search.cpp", "^program: (search|slurm)")
bug("merge-leaves-the-last", "k < o.stores.size()", "k + 1 < o.stores.size()", "the last store is not taken in")

bug = in_file("cli/replay_file.cpp", VIEWER)
bug("scene-of-another", "!AreSame(model.Problem(0), problem)", "false",
    "forces are drawn in a scene that is of another problem")

# ---- What the program and Python ask by names --------------------------------------

PYTHON_TESTS = "^python: "

bug = in_file("certify/request.cpp", PYTHON_TESTS)
bug("follow-without-path", "if (facts.has_path) followed.push_back(facts.name);", "followed.push_back(facts.name);",
    "methods without a path are followed")
bug("policy-of-any-method", 'wanted.method != "baraff" && request.options.policy != Policy{}', "false",
    "a reading of the published algorithm is asked of another method, and ignored")
bug("sides-of-any-number", "!AreSides(wanted.options.sides)", "false", "polygons of six sides are taken")
bug("space-refused", "request.arithmetic = Arithmetic::kDouble;", "", "no replay in space without --arithmetic")
bug("budgets-of-claims", "wanted.limits", "Limits{}", "certify has the usual budgets, whatever is asked for")
bug("grid-is-no-name", 'text == "*"', "false", "'*' is no policy")

bug = in_file("cli/narration/followed.cpp", PYTHON_TESTS)
bug = in_file("cli/narration/over_intervals.cpp", PYTHON_TESTS)
bug("proved-of-solved", "outcome == Outcome::kSolved", "false", "a run that ends solved is run over intervals, too")

bug = in_file("python/module.cpp", PYTHON_TESTS)
bug("not-finite", "std::isfinite(x)", "true", "what is no number becomes a rational")
bug("nan-between", "!(value >= least && value <= most)", "value < least || value > most", "NaN lies between any two")
bug("budgets-of-certify", "SetNumbers(wanted.limits, numbers);", "", "budgets of certify are not set")
bug("rows-of-any-length", 'RequireShape("A", {std::ssize(texts), std::ssize(row)}, rows);', "",
    "rows of exact numbers have any length")
bug("proof-untold", 'if (proved) json["over_intervals"] = EndToJson(*proved);', "",
    "what intervals say of a run in space is not told")

bug = in_file("python/search.cpp", PYTHON_TESTS)
bug("two-best", "BestOf(store_, 1)", "BestOf(store_, 2)", "of a generator and a number of contacts there are two best")
bug("machine-unnamed", "options.machine = MachineText();", "", "a search does not name its machine")
