// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/read_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "corpus/formats/formats.h"
#include "corpus/json_text.h"
#include "corpus/record/scene_file.h"
#include "scene/assemble.h"

namespace stiction {

bool IsStore(const std::filesystem::path& file) {
  constexpr std::string_view kStoreSignature = "SQLite format 3";
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::string first(kStoreSignature.size(), ' ');
  std::ifstream(file, std::ios::binary).read(first.data(), static_cast<std::streamsize>(first.size()));
  return first == kStoreSignature;
}

namespace {

constexpr const char* kWhatIsRead =
    "a problem or a scene in JSON, a Siconos .dat, an FCLIB .hdf5, or STORE:FINDING "
    "(corpus/formats/problems.md has examples). Matrices of numpy and MatrixMarket: stiction.Problem(A, b, mu) "
    "in "
    "Python, or the page paste.html of ./run site";

// ---- Findings ----

// Where the name of the store ends in STORE:FINDING, if it is that.
std::size_t EndOfStore(const std::string& file) {
  if (std::filesystem::exists(file)) return file.npos;
  for (std::size_t at = file.find(':'); at != file.npos; at = file.find(':', at + 1)) {
    if (IsStore(file.substr(0, at))) return at;
  }
  return file.npos;
}

// Up to five signatures, for a refusal.
std::string Some(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min<std::size_t>(findings.size(), 5); ++i)
    names.push_back(Shortened(findings[i].signature));
  const std::string more = findings.size() > 5 ? fmt::format(", ... ({} in all)", findings.size()) : "";
  return fmt::format("{}{}", fmt::join(names, ", "), more);
}

Finding FindingNamed(const std::string& store, const std::string& name, const std::string& source) {
  const std::vector<Finding> findings = Store::OpenToRead(store).Findings();
  std::vector<Finding> fit;
  for (const Finding& finding : findings) {
    if (finding.signature == name) fit = {finding};
    if (finding.signature == name) break;
    if (finding.signature.starts_with(name)) fit.push_back(finding);
  }
  if (findings.empty())
    throw InputError(fmt::format("{}: found no findings in {}, expected a finding; stiction search makes some",
                                 source, store));
  if (fit.size() != 1)
    throw InputError(fmt::format("{}: found {} findings that begin with '{}', expected one, such as {}", source,
                                 fit.size(), name, Some(fit.empty() ? findings : fit)));
  return fit.front();
}

// ---- Scenes ----

template <class Kind>
ProblemFile ProblemOf(const SceneFileIn<Kind>& scene, const std::string& source) {
  const auto model = Assemble(scene.scene, FindContacts(scene.scene));
  if (model.islands.empty())
    throw InputError(source + ": found a scene in which nothing touches, expected a contact or a joint");
  if (model.islands.size() != 1)
    throw InputError(
        fmt::format("{}: found a scene of {} independent problems, expected one; stiction assemble {} -o "
                    "problem.json writes each",
                    source, model.islands.size(), source));
  ProblemFile file;
  file.name = scene.scene.name;
  file.problem = model.InFactors(0);
  file.scene = ToJson(scene);
  return file;
}

ProblemFile ProblemOfScene(const std::string& text, const std::string& source) {
  return std::visit([&source](const auto& scene) { return ProblemOf(scene, source); },
                    ParseAnyScene(text, source));
}

// ---- Formats of others ----

bool LooksLikeJson(std::string_view text) {
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  return at != text.npos && (text[at] == '{' || text[at] == '[' || text[at] == '"');
}

bool IsScene(std::string_view text, const std::string& source) {
  if (text.find("stiction-scene") == text.npos) return false;  // most are none, and are not parsed twice
  return JsonPlace(text, source).HasFormat("stiction-scene");
}

// Of a scene that makes one problem.
std::optional<ExactFactors> FactorsOfScene(const Json& json, const std::string& source) {
  const auto assembled = [](const auto& file) -> std::optional<ExactFactors> {
    const auto model = Assemble(file.scene, FindContacts(file.scene));
    if (model.islands.size() != 1) return std::nullopt;
    return model.InFactors(0);
  };
  try {
    return std::visit(assembled, ParseAnyScene(JsonText(json), source));
  } catch (const InputError&) {  // a text in place of one, as where a problem came of it
    return std::nullopt;
  }
}

ProblemFile ReadAny(const std::filesystem::path& file, const std::string& source) {
  if (const auto named = FindNamed(file)) {
    const Finding& finding = named->finding;
    return ParseProblem(finding.minimized.empty() ? finding.problem : finding.minimized, source, kAnyRows);
  }
  if (IsStore(file))
    throw InputError(
        fmt::format("{0}: found a store, expected a problem; {0}:FINDING is that of a finding, by "
                    "its signature, which stiction report {0} --text lists",
                    source));
  std::string text = ReadText(file);
  const std::string ending = file.extension().string();
  if (LooksPublished(text)) return ParsePublished(std::move(text), file);
  if (ending == ".json" || LooksLikeJson(text))
    return IsScene(text, source) ? ProblemOfScene(text, source) : ParseProblem(text, source, kAnyRows);
  if (ending == ".dat" || ending == ".hdf5") return ParsePublished(std::move(text), file);
  throw InputError(source, "line 1", text.empty() ? "nothing" : "neither JSON nor numbers", kWhatIsRead);
}

}  // namespace

AnyProblem InFactors(const ProblemFile& file) {
  if (file.problem.factors() != nullptr || !file.scene) return file.problem;
  auto factors = FactorsOfScene(file.scene, file.name);
  if (!factors || factors->rows() != file.problem.rows()) return file.problem;
  const AnyProblem in_factors = *std::move(factors);
  const ExactProblem &formed = in_factors, &given = file.problem;
  return formed.A == given.A && formed.b == given.b ? in_factors : file.problem;
}

std::optional<NamedFinding> FindNamed(const std::filesystem::path& file) {
  const std::string source = file.string();
  const std::size_t end = EndOfStore(source);
  if (end == source.npos) return std::nullopt;
  const std::string store = source.substr(0, end);
  return NamedFinding{store, FindingNamed(store, source.substr(end + 1), source)};
}

ProblemFile ReadProblem(const std::filesystem::path& file, int most_rows) {
  const std::string source = file.string();
  ProblemFile read = ReadAny(file, source);
  if (read.problem.rows() > most_rows) RequireFewRows(read.problem, source);
  return read;
}

}  // namespace stiction
