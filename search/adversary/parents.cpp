// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/parents.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "corpus/formats/read_problem.h"
#include "corpus/input_error.h"
#include "corpus/json_text.h"
#include "corpus/rounded.h"
#include "search/adversary/objective.h"
#include "search/adversary/optimized_unit.h"

namespace stiction {
namespace {

constexpr std::size_t kMostParents = 16;  // of a store, by generator and size; and sums of candidates

// ---- Choices of integers and psd ---------------------------------------------------------------------

// As their generators take them: friction, the number of columns, J column by column, for integers whether b is
// J y or A x, and y or x.
struct Blocks {
  int rows = 0, columns = 0;
  std::vector<std::int64_t> J, of_b, image;  // of_b: none or one
};

Blocks BlocksOf(const Candidate& candidate) {
  std::vector<Choice> made;
  RoundedOf(candidate, &made);
  Blocks blocks;
  blocks.rows = 2 * candidate.contacts;
  auto next = made.begin() + (made.front().value == 0 ? 2 : 1 + candidate.contacts);  // past the friction
  const auto take = [&next](std::size_t count) {
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back((next++)->value);
    return values;
  };
  blocks.columns = static_cast<int>(take(1).front());
  blocks.J = take(static_cast<std::size_t>(blocks.rows) * static_cast<std::size_t>(blocks.columns));
  if (candidate.generator == GeneratorId::kIntegers) blocks.of_b = take(1);
  blocks.image = take(static_cast<std::size_t>(made.end() - next));
  return blocks;
}

// One friction coefficient, the only one of the palette.
std::vector<std::int64_t> SequenceOf(const Blocks& blocks) {
  std::vector<std::int64_t> choices = {0, 0, blocks.columns};
  for (const auto* part : {&blocks.J, &blocks.of_b, &blocks.image})
    choices.insert(choices.end(), part->begin(), part->end());
  return choices;
}

// ---- What --from names ---------------------------------------------------------------------------------

bool Has(const Campaign& campaign, GeneratorId generator) {
  return std::ranges::find(campaign.generators, generator) != campaign.generators.end();
}

// `campaign`: of psd alone it takes what other generators chose as NearPsd; null: as it is.
Candidate CandidateOfFile(const ProblemFile& file, const std::string& source, const Campaign* campaign) {
  if (HasChoices(file)) {
    Candidate candidate = CandidateOf(file, source);
    if (campaign == nullptr || Has(*campaign, candidate.generator) || !Has(*campaign, GeneratorId::kPsd))
      return candidate;
  }
  return NearPsd(file.problem, source);
}

Candidate CandidateOfFinding(const Campaign& campaign, const Finding& finding, const std::string& source) {
  const ProblemFile file = ParseProblem(finding.problem, source);
  return HasChoices(file) ? CandidateOf(file, source) : CandidateOf(campaign, finding.unit, finding.index);
}

Candidate CandidateOfOne(const std::string& source, const Campaign* campaign) {
  if (const auto named = FindNamed(source)) {
    const Store store = Store::OpenToRead(named->store);
    return CandidateOfFinding(CampaignOf(store.identity(), named->store), named->finding, source);
  }
  if (source.ends_with(".json")) {
    const JsonPlace root(ReadText(source), source);
    if (const auto problem = root.HasFormat("stiction-record") ? root.Optional("problem") : std::nullopt)
      return CandidateOfFile(ParseProblem(JsonText(problem->json()), source + ": problem"), source, campaign);
  }
  return CandidateOfFile(ReadProblem(source), source, campaign);
}

std::vector<Candidate> AllOfStore(const std::string& source) {
  const Store store = Store::OpenToRead(source);
  std::vector<Candidate> all;
  for (Elite& elite : BestOf(store, kMostParents)) all.push_back(std::move(elite.candidate));
  if (!all.empty()) return all;
  const Campaign campaign = CampaignOf(store.identity(), source);
  for (const Finding& finding : store.Findings()) all.push_back(CandidateOfFinding(campaign, finding, source));
  return all;
}

// What cannot be a candidate is passed over.
std::vector<Candidate> AllOfFolder(const std::string& source) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(source)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  std::vector<Candidate> all;
  for (const std::string& file : files) {
    try {
      all.push_back(CandidateOfOne(file, nullptr));
    } catch (const InputError&) {
    }
  }
  return all;
}

// The largest, of a problem that NearPsd takes.
MuChoice FrictionForPsd(const ExactProblem& problem, const std::string& source) {
  const auto refuse = [&source](const std::string& found) {
    throw InputError(
        fmt::format("{}: found {}, expected a planar problem of 1 to {} static contacts: this is what "
                    "a search can start from without choices in its origin",
                    source, found, kMaxContacts));
  };
  if (problem.dimension != 2) refuse("a problem in space");
  if (problem.contacts.empty() || problem.contacts.size() > kMaxContacts)
    refuse(fmt::format("{} contacts", problem.contacts.size()));
  Rational mu = 0;
  for (const Contact<Rational>& contact : problem.contacts) {
    if (contact.kind != ContactKind::kStatic) refuse(fmt::format("a contact that is {}", Name(contact.kind)));
    mu = std::max<Rational>(mu, contact.mu);
  }
  const int most = LargestMuPart(GeneratorId::kPsd);
  if (mu.get_num() > most || mu.get_den() > most) refuse(fmt::format("friction coefficient {}", ToString(mu)));
  return {static_cast<int>(mu.get_num().get_si()), static_cast<int>(mu.get_den().get_si())};
}

// A number as a multiple of 2^-bits in [-1, 1).
std::int64_t AsMultiple(double x, int bits) {
  const std::int64_t one = std::int64_t{1} << bits;
  return std::clamp<std::int64_t>(std::llround(std::ldexp(x, bits)), -one, one - 1);
}

}  // namespace

std::vector<Candidate> ParentsFrom(const std::string& source, const Campaign& campaign) {
  const bool is_folder = std::filesystem::is_directory(source);
  if (!is_folder && !IsStore(source)) return {CandidateOfOne(source, &campaign)};
  std::vector<Candidate> parents = is_folder ? AllOfFolder(source) : AllOfStore(source);
  std::erase_if(parents, [&](const Candidate& parent) { return !ObstacleOf(parent, campaign).empty(); });
  if (parents.empty())
    throw InputError(
        fmt::format("{}: found no problem of the search's generators, sizes and friction, expected "
                    "one at least; --generator, --contacts and --mu choose them",
                    source));
  return parents;
}

bool HasDirectSums(GeneratorId generator) {
  return generator == GeneratorId::kIntegers || generator == GeneratorId::kPsd;
}

std::optional<Candidate> DirectSum(const Candidate& left, const Candidate& right) {
  if (left.generator != right.generator || !HasDirectSums(left.generator) ||
      left.contacts + right.contacts > kMaxContacts)
    return std::nullopt;
  const Blocks first = BlocksOf(left), second = BlocksOf(right);
  if (first.of_b != second.of_b) return std::nullopt;
  Blocks sum{first.rows + second.rows, first.columns + second.columns, {}, first.of_b, first.image};
  const auto rows = [](const Blocks& blocks) { return static_cast<std::size_t>(blocks.rows); };
  for (int k = 0; k < first.columns; ++k) {
    const auto column = first.J.begin() + k * first.rows;
    sum.J.insert(sum.J.end(), column, column + first.rows);
    sum.J.insert(sum.J.end(), rows(second), 0);
  }
  for (int k = 0; k < second.columns; ++k) {
    const auto column = second.J.begin() + k * second.rows;
    sum.J.insert(sum.J.end(), rows(first), 0);
    sum.J.insert(sum.J.end(), column, column + second.rows);
  }
  sum.image.insert(sum.image.end(), second.image.begin(), second.image.end());
  return Candidate{left.generator, left.contacts + right.contacts, left.mu, left.gravity_only, SequenceOf(sum)};
}

std::vector<Candidate> Enlarged(const std::vector<Candidate>& smaller, const Candidate& like,
                                std::uint64_t seed) {
  std::vector<Candidate> sums;
  for (const Candidate& candidate : smaller) {
    const int missing = like.contacts - candidate.contacts;
    if (candidate.generator != like.generator || missing <= 0 || sums.size() == kMostParents) continue;
    const auto partner = std::find_if(smaller.begin(), smaller.end(), [&](const Candidate& other) {
      return other.generator == like.generator && other.contacts == missing;
    });
    std::optional<Candidate> sum;
    if (partner != smaller.end()) sum = DirectSum(candidate, *partner);
    Candidate random = candidate;
    random.contacts = missing;
    // Half of the random ones make b the other way.
    for (std::uint64_t k = 0; k < 8 && !sum; ++k) {
      const std::uint64_t drawn = Mix(seed + sums.size() * 8 + k);
      sum = DirectSum(candidate, RandomCandidate(random, drawn));
    }
    if (sum) sums.push_back(*std::move(sum));
  }
  return sums;
}

std::string ObstacleOf(const Candidate& parent, const Campaign& campaign) {
  const auto has = [](const auto& list, const auto& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  const bool grows = HasDirectSums(parent.generator) &&
                     parent.contacts < *std::max_element(campaign.contacts.begin(), campaign.contacts.end());
  if (!has(campaign.generators, parent.generator) || !(grows || has(campaign.contacts, parent.contacts)) ||
      parent.gravity_only != campaign.gravity_only)
    return fmt::format("found {} of {} contacts{}, expected problems of the campaign's kind",
                       Row(parent.generator).name, parent.contacts,
                       parent.gravity_only ? " under gravity only" : "");
  const int most = LargestMuPart(parent.generator);
  const bool fits = parent.mu.numerator <= most && parent.mu.denominator <= most;
  if (fits && (FindObjective(campaign.objective)->lowers_friction || has(campaign.palette, parent.mu)))
    return "";
  return fmt::format("found friction coefficient {}/{}, expected one of the campaign's", parent.mu.numerator,
                     parent.mu.denominator);
}

Candidate CandidateOf(const Campaign& campaign, std::int64_t unit, std::int64_t index) {
  const Task task = TaskOf(Schedule(campaign), unit);
  std::vector<Choice> made;
  Choices choices(
      ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), static_cast<std::uint64_t>(index)), &made);
  ContactProblem<double> problem;
  Generate<double, Eigen::Dynamic>(task.generator, task.contacts, SurroundingsOf(campaign), choices, problem);
  const MuChoice mu = campaign.palette[static_cast<std::size_t>(made[1].value)];
  Candidate candidate{task.generator, task.contacts, mu, campaign.gravity_only, {0, 0}};
  for (std::size_t i = made.front().value == 0 ? 2 : 1 + problem.contacts.size(); i < made.size(); ++i)
    candidate.choices.push_back(made[i].value);
  return candidate;
}

Candidate NearPsd(const ExactProblem& exact, const std::string& source) {
  Candidate candidate{
      GeneratorId::kPsd, static_cast<int>(exact.contacts.size()), FrictionForPsd(exact, source), false, {}};
  const ContactProblem<double> problem = Rounded<double>(exact);
  const int rows = problem.rows();
  Eigen::VectorXd units(rows);  // that make the rows of J at most 1
  for (int i = 0; i < rows; i += 2) {
    const double largest = std::max(problem.A(i, i), problem.A(i + 1, i + 1));
    units.segment(i, 2).setConstant(largest > 0 ? 1 / std::sqrt(largest) : 1.0);
  }
  const Eigen::MatrixXd A = units.asDiagonal() * problem.A * units.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(A);
  const Eigen::VectorXd& values = parts.eigenvalues();  // ascending
  Blocks blocks;
  blocks.rows = rows;
  for (int k = rows - 1; k >= 0; --k) {
    if (k < rows - 1 && values[k] <= 1e-12 * values[rows - 1]) break;
    const Eigen::VectorXd column = std::sqrt(std::max(values[k], 0.0)) * parts.eigenvectors().col(k);
    for (const double entry : column) blocks.J.push_back(AsMultiple(entry, 15));
    ++blocks.columns;
  }
  const Eigen::VectorXd b = units.asDiagonal() * problem.b;
  const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(b);
  const double largest = x.lpNorm<Eigen::Infinity>();
  for (const double entry : x) blocks.image.push_back(AsMultiple(largest > 0 ? entry / largest : 0.0, 11));
  candidate.choices = SequenceOf(blocks);
  return candidate;
}

}  // namespace stiction
