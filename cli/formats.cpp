// SPDX-License-Identifier: Apache-2.0
// stiction import, stiction export: problems in the formats of others, and programs that show findings.

#include "corpus/formats/formats.h"

#include <fmt/format.h>

#include "cli/command_line.h"
#include "cli/shared.h"
#include "corpus/grouped.h"
#include "corpus/named_rows.h"
#include "corpus/record/asymmetry.h"
#include "search/campaign.h"
#include "search/under_test/reproducer.h"

namespace stiction {
namespace {

std::string StoragesText() {
  std::vector<std::string> rows;
  for (const PublishedFormat& format : PublishedFormats()) {
    rows.push_back(fmt::format("{}: {}", format.name, fmt::join(format.storages, ", ")));
  }
  return fmt::format("{}", fmt::join(rows, "; "));
}

// The words of both verbs.
struct FormatsVerb {
  std::string file, output, format;
  std::string storage;      // export: how it has A
  bool symmetrize = false;  // import
  bool round = false;       // export
  std::string reproducer;   // export: of kReproducerNames
  bool json = false;
};

int Import(const FormatsVerb& o) {
  ProblemFile file = o.format.empty() ? ReadProblem(o.file, kAnyRows) : ReadPublished(o.file, o.format);
  if (o.symmetrize) Symmetrize(file);
  WriteText(o.output, Print(file));
  const AnyProblem& problem = file.problem;
  const Asymmetry asymmetry = LargestAsymmetry(problem);
  SayWhatWasDone(o.output, o.json,
                 fmt::format("{}: {}, dimension {}, largest abs(A - A') {:.3g}\n", o.output,
                             Counted(static_cast<std::int64_t>(problem.contacts().size()), "contact"),
                             problem.dimension(), ToDouble(asymmetry.difference)),
                 {{"written", std::vector{o.output}},
                  {"contacts", std::ssize(problem.contacts())},
                  {"dimension", problem.dimension()},
                  {"asymmetry", ToString(asymmetry.difference)}});
  return kExitDone;
}

// A program that shows what a solver under test does wrong.
int WriteReproducer(const FormatsVerb& o) {
  if (!o.format.empty() || !o.storage.empty() || o.round)
    throw InputError("export: found --reproducer with --format, --storage or --round, expected it without");
  const auto named = FindNamed(o.file);
  if (!named)
    throw InputError(fmt::format("{}: found no finding, expected STORE:FINDING with --reproducer", o.file));
  const Campaign campaign = CampaignOf(Store::OpenToRead(named->store).identity(), named->store);
  const std::string file = std::filesystem::path(o.output).filename().string();
  WriteText(o.output,
            ReproducerOf(named->finding, campaign.solver, o.reproducer, o.output == "-" ? "FILE" : file));
  SayWhatWasDone(o.output, o.json, fmt::format("{}: its first lines say how it runs\n", o.output),
                 {{"written", std::vector{o.output}}, {"rounded", 0}, {"largest_change", "0"}});
  return kExitDone;
}

int Export(const FormatsVerb& o) {
  if (!o.reproducer.empty()) return WriteReproducer(o);
  if (o.format.empty()) throw InputError("export: found neither --format nor --reproducer, expected one");
  const ProblemFile problem = ReadProblem(o.file, kAnyRows);
  const Rounding rounding = o.round ? Rounding::kAllowed : Rounding::kRefused;
  const ExportReport report = WritePublished(problem, o.output, o.format, o.storage, rounding);
  std::string text = fmt::format("{}: {} rounded", o.output, Counted(report.rounded, "number"));
  if (report.rounded > 0)
    text += fmt::format(", by {:.2g} of their value at most", ToDouble(report.largest_change));
  SayWhatWasDone(o.output, o.json, text + "\n",
                 {{"written", std::vector{o.output}},
                  {"rounded", report.rounded},
                  {"largest_change", ToString(report.largest_change)}});
  return kExitDone;
}

}  // namespace

const ListedVerb kImportVerb("Solve", 80, [](CommandLine& program) {
  auto [verb, o] = program.Add("import", "Write what is read as a whole stiction-problem file", Import);
  verb.Positional("FILE", o.file, kFileHelp)
      .Required()
      .Details(std::string(kFileDetails) +
               ". Siconos: LCP, MLCP, friction, local and global; FCLIB: local and global. Other kinds "
               "(rolling, relay, ...) are refused by their name");
  verb.Option("-o,--output", o.output, "stiction-problem to write; - is standard output").Required();
  verb.Option("--format", o.format, "the format of the file; by default its content decides")
      .OneOf(NamesOf(PublishedFormats()));
  verb.Flag("--symmetrize", o.symmetrize, "replace A by (A + A')/2; `origin` keeps the largest difference");
  verb.Prints(o.json, "a problem that was read from another format", R"({
      written: written, contacts: integer, dimension: 2 | 3,
      asymmetry: exact  // the largest difference of A and its transpose
    })");
});

const ListedVerb kExportVerb("Solve", 90, [](CommandLine& program) {
  auto [verb, o] =
      program.Add("export", "Write a problem in another format, or a program that shows a finding", Export);
  verb.Positional("FILE", o.file, kFileHelp).Required().Details(kFileDetails);
  verb.Option("-o,--output", o.output, "file to write; - is standard output").Required();
  verb.Option("--format", o.format, "the format to write").OneOf(NamesOf(PublishedFormats()));
  verb.Option("--storage", o.storage, "how the matrix is stored; by default the first of its format")
      .Details(StoragesText());
  verb.Flag("--round", o.round, "write the nearest double for a number that is none");
  verb.Option("--reproducer", o.reproducer,
              "instead of a format: of a finding of search --solver, a program that shows it")
      .OneOf({kReproducerNames.begin(), kReproducerNames.end()})
      .Details(
          "At most 60 lines, which print what goes wrong and the right forces. c is linked with the library "
          "under test, python takes it or the program as its argument, the others are C++ over their package "
          "alone; the first comment has the command");
  verb.Prints(o.json, "a problem that was written in another format", R"({
      written: written, rounded: integer,  // numbers that are no doubles
      largest_change: exact})");
});

}  // namespace stiction
