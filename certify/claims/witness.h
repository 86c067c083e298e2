// SPDX-License-Identifier: Apache-2.0
// Certificates put together, and their witnesses read.
//
// A witness comes from anywhere. What the functions below expect of it and do not find is thrown as `Rejected`,
// and ends the check of the certificate: CheckCertificate (certificate.h) makes a reason of it.

#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "certify/exact/modes.h"
#include "certify/exact/rejected.h"
#include "corpus/exact_problem.h"
#include "corpus/json_text.h"

namespace stiction {

// ---- Making ------------------------------------------------------------------------------------

// `stiction-certificate`, version 1, of this claim.
Json MakeCertificate(const char* claim, const ExactProblem& problem, Json witness);
Json WordToJson(const ModeWord& word);

// ---- Reading -----------------------------------------------------------------------------------

// More work than any checker does for a certificate, whether its claim is true or not.
struct TooDear : Rejected {};

// ---- Cost --------------------------------------------------------------------------------------
//
// What a check will cost is bounded before it begins, in every checker by the same rule (certificates.md, What
// a check may cost): so much that is free, and so much for every character of what was read. `operations`
// counts those of the check on short numbers; they take longer by the square of the bits of numbers, which are
// bounded by those of rows and vectors over their common denominators, which add up: a determinant of A has no
// more bits than the rows of A together.

// That of the certificate which this thread reads, as long as this lives.
class Budget {
 public:
  static constexpr double kFreeWork = 6e12, kWorkPerCharacter = 250'000;
  static constexpr std::int64_t kFreeDigits = 1'000'000, kDigitsPerCharacter = 2;
  static constexpr std::int64_t kFreeCells = 2'000'000, kCellsPerCharacter = 5;
  static constexpr double kShort = 1e6;  // the square of the bits with which an operation takes twice as long

  // Of values of a certificate.
  explicit Budget(std::initializer_list<const Json*> values);
  ~Budget() { length_ = before_; }
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  static std::int64_t Length() { return length_; }  // characters of texts and keys, and two for every value
  static double MostWork() { return kFreeWork + kWorkPerCharacter * static_cast<double>(length_); }
  static std::int64_t MostDigits() { return kFreeDigits + kDigitsPerCharacter * length_; }
  static std::int64_t MostCells() { return kFreeCells + kCellsPerCharacter * length_; }

 private:
  inline static thread_local std::int64_t length_ = 0;
  std::int64_t before_;
};

// TooDear: what was found, and the limit that it exceeds.
[[noreturn]] void RefuseCost(const std::string& found, const std::string& most);
void RequireWork(double work);  // TooDear beyond that of the budget

// Each with numbers of n rows; `times`: how often.
double ProductOperations(double n, double times);      // A x
double EliminationOperations(double n, double times);  // of A
double WordOperations(double n, double times);     // of a reduced determinant: of half of the rows, on average
double StepOperations(double n, double policies);  // of a step in the plane
double StepInSpaceOperations(double n, double coordinates, double times);

class Cost {
 public:
  // TooDear beyond the work of the budget.
  explicit Cost(double operations);

  // Each adds bits, and throws TooDear where there are too many.
  Cost& Numbers(std::span<const Rational> numbers, int times = 1);  // over their common denominator
  Cost& Vector(const ExactVector& x, int times = 1);
  Cost& AddBits(std::int64_t bits);
  Cost& LongestRow(const ExactProblem& problem);  // or column, of A and b
  Cost& AllRows(const ExactProblem& problem);     // of A and b, each with the coefficients of friction

  // Of numbers over their common denominator; above most() they are not told exactly.
  std::int64_t Bits(std::span<const Rational> numbers) const;
  std::int64_t BitsOf(const ExactVector& x) const;
  std::int64_t most() const { return most_; }
  std::int64_t bits() const { return bits_; }

 private:
  void Add(std::int64_t bits);

  std::int64_t most_, bits_ = 0;
};

// TooDear unless A x and A'x are cheap, added up over the groups of rows that A couples: so many rows of long
// numbers, and entries by which long ones are multiplied. Square: nor are x'Ax and x'b dear, of all rows.
void RequireCheapProduct(const ExactProblem& problem, const ExactVector& x);
void RequireCheapSquare(const ExactProblem& problem, const ExactVector& x);

// An object with exactly these keys, in any order.
void RequireKeys(const Json& json, const std::string& path, const std::set<std::string>& keys);
void RequireEqual(const Rational& found, const Rational& expected, const std::string& path);
// A list; of `size` items.
void RequireList(const Json& json, const std::string& path);
void RequireList(const Json& json, const std::string& path, std::size_t size, const char* items);

Rational ReadNumber(const Json& json, const std::string& path);
std::int64_t ReadInteger(const Json& json, const std::string& path, std::int64_t least);
ExactVector ReadVector(const Json& json, const std::string& path, int size);
// Modes of the first contacts of the problem, of their kinds.
ModeWord ReadPrefix(const Json& json, const std::string& path, const ExactProblem& problem);

// A check of a witness against its problem: the facts of an accepted one, otherwise Rejected is thrown.
using WitnessCheck = Json(const ExactProblem&, const Json& witness);

// What the check finds wrong; empty if it accepts, and if it is too dear to be made.
std::optional<Rejected> FindFault(WitnessCheck& check, const ExactProblem& problem, const Json& witness);

}  // namespace stiction
