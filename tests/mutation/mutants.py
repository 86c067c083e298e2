# SPDX-License-Identifier: Apache-2.0
"""Bugs by hand (mutate.py): one for each clause of the checkers that a drawn one might miss.

  function   which has the code, wherever its file is
  name       by which the bug is told; unique
  original   code that stands once in the function. In C++ a statement ends in ; and may be replaced by nothing.
             Anything else is an expression, and in Python all is.
  mutated    what stands in its place
  breaks     what is wrong then
  type       into which both expressions are converted, where they have none in common
  equivalent why no test can tell the two apart
"""

from collections import namedtuple

FOLDERS = ("certify/claims", "certify/exact", "certify/check_certificate.py", "solver/problem", "search/under_test")  # where functions are

Row = namedtuple("Row", "function id original mutated breaks type equivalent")
HAND = []


def bug(function, name, original, mutated, breaks, type=None, equivalent=None):
    HAND.append(Row(function, name, original, mutated, breaks, type, equivalent))

# ---- The gate ----

bug("Bound", "rounding-not-bounded", "MeasureErrors(problem, law, f, a_, meter_, Scalar(gate.theta()), &rounding_)",
    "MeasureErrors(problem, law, f, a_, meter_, Scalar(gate.theta()))", "the errors are not upper bounds")
bug("NearestFriction", "beyond-the-limit",
    "if (bounded) mode.friction = measure.OfFriction(friction.Excess(i, at), at.force_unit);", "",
    "a contact that sticks has any friction")
bug("Measure", "separates-with-forces", "if (f[row + k] != 0) AddGhost(problem, f, i, row + k);", "",
    "a contact that separates may have forces")
bug("AddGhost", "acts-on-nothing", "if (!acts) modes_[contact].friction = most_;", "",
    "a force that acts on no row is none")

# ---- certify/claims/solution.cpp ----

bug("CheckCoulomb", "claim-coulomb-above-one", "bound <= 0 || bound > 1", "bound <= 0",
    "coulomb-solution: a bound above 1")
bug("ReadForces", "claim-accelerations", 'RequireEqual(a[i], answer[i], fmt::format("witness.a[{}]", i));', "",
    "solution-exists: any a")

# ---- certify/claims/matrix.cpp ----

bug("RequireSymmetric", "claim-symmetric",
    """throw Rejected{fmt::format("problem.A[{}][{}]", pair->first, pair->second), "an entry unlike its mirror",
                   "A = A'"};""", "", "every A is symmetric")
bug("RequireFactors", "claim-psd-negative", "D[i] < 0", "false", "psd: D may be negative")
bug("RequireFactors", "claim-psd-column",
    """RequireEqual(rest(i, k), L(i, k) * D[k], fmt::format("(A - L diag(D) L')[{}][{}]", i, k));""", "",
    "psd: any L and D")
bug("RequireFactors", "claim-psd-triangle",
    'RequireEqual(L(i, j), i == j ? 1 : 0, fmt::format("witness.L[{}][{}]", i, j));', "", "psd: L of any form")
bug("CheckNotSemidefinite", "claim-not-psd-zero", "curvature >= 0", "curvature > 0", "not-psd: x'Ax = 0 will do")
bug("CheckInRange", "claim-in-range", 'RequireEqual(image[i], problem.b[i], fmt::format("(A x)[{}]", i));', "",
    "in-range: any x")
bug("CheckNotInRange", "claim-not-in-range-kernel", """RequireEqual(image[j], 0, fmt::format("(y'A)[{}]", j));""",
    "", "not-in-range: y'A may be anything")
bug("CheckNotInRange", "claim-not-in-range-zero",
    """if (product == 0) throw Rejected{"witness.value", "0", "y'b /= 0"};""", "", "not-in-range: y'b = 0 will do")
bug("RequireDefinite", "claim-definite", "D[i] <= 0", "D[i] < 0", "definite: semidefinite is enough")
bug("CheckNotDefinite", "claim-not-definite-zero",
    'if (x.isZero()) throw Rejected{"witness.x", "0", "another vector"};', "", "not-definite: by x = 0")

# ---- certify/claims/by_factors.cpp ----

bug("RequireFactorsOfProblem", "claim-factors-definite",
    """if (!factors) throw Rejected{"witness.factors.M", "a block that is not definite", "a positive definite one"};""", "",
    "factors: no matter whether M is definite")
bug("RequireFactorsOfProblem", "claim-factors-matrix",
    """RequireEqual(stated.A(i, j), problem.A(i, j), fmt::format("(J inv(M) J')[{}][{}]", i, j));""", "", "factors: of any A")
bug("RequireFactorsOfProblem", "claim-factors-free",
    'RequireEqual(stated.b[i], problem.b[i], fmt::format("(J w + c)[{}]", i));', "", "factors: of any b")
bug("CheckFactoredHypothesis", "claim-factors-cone",
    """throw Rejected{"witness.factors.c", *violation, "a vector of the dual cone"};""", "", "factors: any c shows (H)")

# ---- certify/claims/hypothesis.cpp, certify/exact/hypothesis.cpp ----

bug("RequireHypothesis", "claim-h-cone", """throw Rejected{"b - A'y", *violation, "a vector of the dual cone"};""",
    "", "h: any y")
bug("CheckExists", "claim-exists-psd", "RequireFactors(problem, witness);", "", "exists: any A")
bug("CheckExists", "claim-exists-h", "RequireHypothesis(problem, witness);", "", "exists: any b")
bug("CheckNotHypothesis", "claim-not-h-cone",
    'if (const auto violation = FindConeViolation(problem, v)) throw Rejected{"witness.v", *violation, "v in K"};',
    "", "not-h: v outside of K")
bug("CheckNotHypothesis", "claim-not-h-kernel", 'RequireEqual(image[i], 0, fmt::format("(A v)[{}]", i));', "",
    "not-h: A v may be anything")
bug("CheckNotHypothesis", "claim-not-h-zero", "product >= 0", "product > 0", "not-h: b'v = 0 will do")
bug("FindDualConeViolation", "dual-normal", 'require(g[row] >= 0, "gN >= 0", g[row]);', "",
    "a dual cone and its opposite")

# ---- certify/claims/cycle.cpp ----

bug("RequireCycle", "claim-cycle-length",
    'RequireSame(stated["pivots"].size(), run.trace.pivots.size(), path + ".pivots: number");', "",
    "cycle: any number of steps")
bug("RequireCycle", "claim-cycle-start",
    'RequireSame(ReadInteger(stated["start"], path + ".start", 0), run.verdict.start, path + ".start");', "",
    "cycle: any start")
bug("CompareState", "claim-cycle-state", 'RequireEqual(f[i], run.f[i], ElementPath(path + ".f", i));', "",
    "cycle: any forces recur")
bug("CheckRuns", "claim-cycle-policy-twice", 'throw Rejected{where, Shown(named[p]), "each policy once"};', "",
    "cycle: a policy counts twice")
bug("CheckRuns", "claim-cycle-run-twice", "p == 0 && !different.insert(StepsAsText(run, names)).second", "false",
    "cycle: a run counts twice")
bug("CheckCounterexample", "claim-counterexample-solution", "RequireSolution(problem, witness);", "",
    "counterexample: any f")

# ---- certify/exact/loops_in_space.cpp ----

bug("LeavesBox", "loops-spread", "k < centre.size()", "k < 1", "box: coordinates depend on the first alone")
bug("FaultOfPlace", "loops-place", "!IsInBox(problem.memory().CoordinatesOf(state, loop.charts), loop.centre, loop.radii)",
    "false", "box: the run need not come to it")
bug("FaultOfStates", "loops-memory", "!problem.memory().Of(state).empty()", "false", "states: anything is remembered")
bug("FaultOfRecurrence", "loops-injective", "!IsInjective(image, moving)", "false", "endless: all points may come to one")
bug("FaultOfRecurrence", "loops-moves", "std::ranges::any_of(moving, moves)", "true", "endless: of a state that recurs")
bug("FaultOfTurnings", "loops-punctured", "return FaultOfRecurrence(problem, state, loop, image);", "return std::nullopt;",
    "punctured: the run may come to the fixed point")
bug("FindLoopFault", "loops-start", "walk.drives() != loop.start", "false", "a start between two scans")
bug("FindRayFault", "loops-ray", "end != Name(Outcome::kRay)", "false", "ray: of a run that ends otherwise")

# ---- What every claim has ----

bug("CheckCertificate", "certificate-digest", "!digest.empty() && report.digest != digest", "false",
    "check --problem: any problem")
bug("ReadClaim", "certificate-version", '!certificate["version"].is_number_integer() || certificate["version"] != 1',
    'certificate["version"] != 1', "version 1.0 is read")
bug("RequireFewRows", "certificate-rows", "rows > kMostRowsOfCertificate", "false", "any number of rows")
bug("RequireFewRows", "certificate-cells", "cells > most", "false", "matrices that nothing pays for")
bug("RequireFewDigits", "certificate-digits", "digits > most", "false", "exponents that nothing pays for")
bug("Add", "work-bits", "bits_ <= most_", "true", "operations on numbers of any length")
bug("RequireWork", "work", "work <= most", "true", "claims of any work")
bug("RequireTouchedBlocks", "velocities-untouched", "untouched == rows_of.end()", "true",
    "factors: velocities that no row touches")
bug("FaultOfNumbers", "loops-large-numbers", "if (!large) return std::nullopt;", "return std::nullopt;",
    "runs in space: numbers that the bits hardly hold")
bug("RequireKeys", "unknown-keys",
    'if (!keys.contains(key)) throw Rejected{path + "." + key, "an unknown key", expected};', "",
    "unknown keys are passed over")

# ---- certify/exact/verify_solution.cpp ----

bug("FindBroken", "cone-normal", 'require(f[row] >= 0, "fN >= 0", f[row]);', "", "forces and cones that pull")
bug("FindBroken", "complementarity", "f[row] == 0 || a[row] == 0", "true", "(15) without fN aN = 0")
bug("FindBroken", "power", "friction.power <= 0", "true", "(16), (21) without fF.aF <= 0")
bug("FindBroken", "planar-bound", "slack >= 0", "plane || slack >= 0", "(16) without its bound")
bug("FindBroken", "space-bound", "slack >= 0", "!plane || slack >= 0", "in space: no bound")
bug("FindBroken", "slip", "product == 0", "true", "(16), (21) without slip at the limit only")
bug("FindBroken", "coulomb-angle", "excess >= 0", "true", "Coulomb's law at any angle")

# ---- certify/claims/no_solution.cpp, certify/exact/farkas.cpp ----

bug("TermIsNonnegative", "break-friction", "return yN >= 0 && yF == 0;", "return yN >= 0;",
    "break: yF may be anything")
bug("TermIsNonnegative", "stick-one-side", "return gN + abs(along) <= 0;", "return gN + along <= 0;",
    "stick: one side of the cone")
bug("TermIsNonnegativeInSpace", "touch-in-space-opposite",
    "g[row] <= 0 && contact.mu * contact.mu * square <= g[row] * g[row]",
    "contact.mu * contact.mu * square <= g[row] * g[row]", "in space, touch: a dual cone and its opposite")
bug("FindRefutationGap", "refutation-of-zero", "farkas.value >= 0", "farkas.value > 0", "y'b = 0 refutes")
bug("RequireCover", "prefix-twice",
    'if (listed.size() < prefixes.size()) throw Rejected{path, "a prefix twice", "each once"};', "",
    "a prefix counts twice")
bug("RequireCover", "prefix-extension",
    'throw Rejected{ElementPath(path, k) + ".modes", "an extension of another prefix", "none"};', "",
    "a prefix and its extensions count")
bug("RequireCover", "cover-less", "covered != words", "covered > words", "words may be left out")

# ---- certify/claims/safe.cpp ----

bug("CheckSafe", "safe-of-zero",
    'if (determinant <= 0) throw Rejected{path, ToString(determinant), "a number > 0"};',
    'if (determinant < 0) throw Rejected{path, ToString(determinant), "a number > 0"};',
    "a determinant of zero is safe")
bug("CheckUnsafe", "unsafe-positive",
    'if (value > 0) throw Rejected{"witness.determinant", ToString(value), "a number <= 0"};', "",
    "a positive determinant is unsafe")
bug("ReadDeterminant", "determinant-stated", "if (value == determinant) return determinant;", "return determinant;",
    "any number is stated")

# ---- certify/claims/condition.cpp ----

bug("CheckSafeByCondition", "condition-least", "!IsSemidefinite(B - least * I)", "false", "any least eigenvalue")
bug("CheckSafeByCondition", "condition-most", "!IsSemidefinite(most * I - B)", "false", "any largest eigenvalue")
bug("IsGoodEnough", "condition-equality", "friction * friction * gap * gap < 4 * least * most",
    "friction * friction * gap * gap <= 4 * least * most", "equality is safe")

# ---- certify/check_certificate.py ----

bug("check_not_symmetric", "py-not-symmetric", "problem.A[i][j] != problem.A[j][i]", "True", "no A is symmetric")
bug("factored", "py-psd-symmetric", "check_symmetric(problem, {})", "None", "psd: A need not be symmetric")
bug("factored", "py-psd-negative", "D[i] >= 0", "True", "psd: D may be negative")
bug("check_definite", "py-definite", "pivot > 0", "pivot >= 0", "definite: semidefinite is enough")
bug("stated", "py-value", "value == computed", "True", "any value is stated")
bug("check_not_definite", "py-not-definite-zero", "any(x)", "True", "not-definite: by x = 0")
bug("check_not_in_range", "py-not-in-range-kernel", """equal(long_times(zip(*problem.A), y), [0] * len(y), "$.witness (y'A)", "y'A = 0")""",
    "None", "not-in-range: y'A may be anything")
bug("in_dual_cone", "py-h-cone", "gN ** 2 >= mu ** 2 * sum(g[k] ** 2 for k in tangents)", "True", "h: dual cones without friction")
bug("solved", "py-factors-definite", """need(pivot > 0, place, pivot, "a pivot > 0 of a definite block")""",
    """need(pivot != 0, place, pivot, "a pivot > 0 of a definite block")""", "factors: masses may be negative")
bug("factors", "py-factors-matrix", "product == problem.A[i][j]", "True", "factors: of any A")
bug("factors", "py-factors-free", """equal(problem.b, b, "$.problem.b", "J w + c")""", "None", "factors: of any b")
bug("check_not_h", "py-not-h-kernel", """equal(long_times(problem.A, v), [0] * len(v), "$.witness (A v)", "A v = 0")""", "None",
    "not-h: A v may be anything")
bug("forces", "py-accelerations", """equal(a, [x + y for x, y in zip(long_times(problem.A, f), problem.b)], "$.witness.a", "A f + b")""",
    "None", "solutions: any a")
bug("check_forces", "py-complementarity", "fN >= 0 and aN >= 0 and fN * aN == 0", "fN >= 0 and aN >= 0",
    "without fN aN = 0")
bug("check_coulomb", "py-coulomb-bound", "0 < bound <= 1", "bound <= 1", "coulomb-solution: a bound of zero or less")
bug("weak", "py-limit", "force2 <= limit2", "True", "sticking with any force")
bug("never_negative", "py-stick-side", "-contact.mu * abs(gF)", "contact.mu * abs(gF)", "stick: the cone's other side")
bug("check_refutation", "py-refutation-zero", "yb < 0", "yb <= 0", "y'b = 0 refutes")
bug("check_no_solution", "py-prefix-twice", "prefix not in prefixes", "True", "no-solution: a prefix counts twice")
bug("check_no_solution", "py-cover", "covered == following[-1]", "True", "no-solution: words may be left out")
bug("check_safe", "py-safe-zero", "value > 0", "value >= 0", "safe: a determinant of zero")
bug("check_safe_by_condition", "py-condition-least", "is_semidefinite(below)", "True", "any least eigenvalue")
bug("check_unsafe", "py-unsafe", "value <= 0", "True", "unsafe: a positive determinant")

# ---- search/under_test ----

bug("AddFriction", "solver-drives", "force * a > 0", "force * a < 0", "friction that drives the slip is called less than its limit")
bug("TakeOutIdle", "solver-idle", "largest > accuracy * accuracy", "false", "any force of idle contacts is none")
bug("KeepsPromises", "solver-hypotheses", "MeetsAssumptions(problem)", "IsSymmetric(problem)",
    "a finding is minimized to a problem that is not semidefinite")
bug("KeepsPromises", "solver-row", "EachRowMoves(found) && !EachRowMoves(problem)", "false", "a finding is minimized to A = 0")
bug("FailsAlike", "solver-alike", "examined.kind == sought.kind && examined.what == sought.what",
    "examined.kind == sought.kind", "a finding is minimized to another failure of its kind")
bug("FailsAlike", "solver-clear", "examined.error >= std::min(sought.error, kClearError * std::stod(about.accuracy))", "true",
    "a finding is minimized to the edge of the accuracy")
bug("Growth", "leak-falls", "growth <= 0 || growth + slack < kSteady * before * span", "growth <= 0",
    "what fills up is a leak")
bug("AsPosed", "solver-scene", "PosedFor(law, RoundedOf(scene, nullptr))", "RoundedOf(scene, nullptr)",
    "a scene's problem keeps its friction under a law without")
