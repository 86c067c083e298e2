// SPDX-License-Identifier: Apache-2.0
#include "reports/papers/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

const By kBySize = {"policy", "contacts"};

Table PaperLoops(const Record& record) {
  Table table =
      Select(FailuresTable(record, {"generator", "contacts", "policy", "arithmetic"}),
             "generator policy arithmetic contacts runs #loops loops=in_a_million_[95_%]",
             "Loops of the published algorithm, confirmed in exact arithmetic, in a million runs, with exact "
             "intervals at 95 % (Garwood). They are lower bounds where runs were not all repeated exactly.");
  table.name = "loops";
  return table;
}

Table PaperContacts(const Record& record) {
  return Select(
      ContactsTable(record, kBySize),
      "policy contacts runs steps with_zero_steps with_give_ups=with_give-ups loops",
      "Runs by number of contacts, all generators together: steps in the mean; runs with a step of length "
      "zero, and with something given up, as shares with exact intervals at 95 % (Clopper and Pearson); "
      "loops confirmed exactly, in a million runs (Garwood).");
}

Table PaperMethods(const Record& record) {
  Table table =
      Select(AgreementTable(record),
             "contacts problems=given solved #with_folds #with_descents compared enumerated=all_modes "
             "disagreements",
             "Complete driving on the problems that were given to it, and methods held against each other "
             "(published algorithm, complete driving, Lemke's method; all contact modes tried of some), by "
             "number of contacts. Each solution was verified exactly.");
  table.name = "methods";
  return table;
}

// ---- Figures: columns of numbers, and what draws them ----

// Loops of runs, by generators that have loops, and contacts.
using LoopCurves = std::map<std::string, std::map<int, Ratio>>;

LoopCurves LoopCurvesOf(const Record& record) {
  LoopCurves curves;
  std::set<std::string> with_loops;
  for (const Group& g : GroupsBy(record, {"policy", "generator", "contacts"})) {
    if (g.Text(0) != "paper") continue;
    curves[g.Text(1)][g.Number(2)] = RateOf(g.counts.Loops(), g.counts.runs);
    if (g.counts.Loops() > 0) with_loops.insert(g.Text(1));
  }
  std::erase_if(curves, [&](const auto& curve) { return !with_loops.contains(curve.first); });
  return curves;
}

// Rows by contacts: a rate in a million and how far its interval reaches; nan where there is no run or no loop,
// which a logarithmic axis cannot show.
std::string LoopData(const LoopCurves& curves) {
  std::string text = "contacts";
  std::set<int> all;
  for (const auto& [generator, sizes] : curves) {
    for (const auto& [contacts, rate] : sizes) all.insert(contacts);
  }
  for (std::size_t i = 1; i <= curves.size(); ++i) text += fmt::format(" g{0} g{0}minus g{0}plus", i);
  text += "\n";
  for (const int contacts : all) {
    text += std::to_string(contacts);
    for (const auto& [generator, sizes] : curves) {
      const auto found = sizes.find(contacts);
      if (found == sizes.end() || found->second.count == 0) {
        text += " nan nan nan";
        continue;
      }
      const Ratio& rate = found->second;
      const double scale = 1e6 / static_cast<double>(rate.of), count = static_cast<double>(rate.count);
      const Interval interval = CountInterval(rate.count);
      text += fmt::format(" {:.9g} {:.9g} {:.9g}", scale * count, scale * (count - interval.low),
                          scale * (interval.high - count));
    }
    text += "\n";
  }
  return text;
}

std::string FigureHead(const std::string& axis) {
  return fmt::format(
      "% Written by stiction; needs pgfplots. Where the data lie: \\newcommand{{\\stictiondata}}{{FOLDER}}\n"
      "\\providecommand{{\\stictiondata}}{{.}}\n\\begin{{tikzpicture}}\n\\begin{{axis}}[width=0.75\\linewidth, "
      "{}]\n",
      axis);
}

std::string LoopFigure(const LoopCurves& curves) {
  std::string text = FigureHead(
      "ymode=log, xlabel={contacts}, ylabel={loops in a million runs}, xtick=data, unbounded coords=discard, "
      "legend pos=outer north east, error bars/y dir=both, error bars/y explicit");
  std::size_t i = 0;
  for (const auto& [generator, sizes] : curves) {
    text += fmt::format(
        "\\addplot+[error bars/.cd, y dir=both, y explicit] table[x=contacts, y=g{0}, y error minus=g{0}minus, "
        "y error plus=g{0}plus] {{\\stictiondata/loops.dat}};\n\\addlegendentry{{{1}}}\n",
        ++i, LatexText(generator));
  }
  return text + "\\end{axis}\n\\end{tikzpicture}\n";
}

// Rows by steps; for each number of contacts the share of its runs.
std::string StepData(const std::vector<Group>& sizes) {
  std::string text = "steps";
  for (const Group& size : sizes) text += fmt::format(" c{}", size.Number(1));
  text += "\n";
  for (int steps = 0; steps < Tally::kBins; ++steps) {
    text += std::to_string(steps);
    for (const auto& [key, tally, counts, stratum] : sizes) {
      text += counts.runs == 0 ? " nan"
                               : fmt::format(" {:.9g}", static_cast<double>(tally.steps[steps]) /
                                                            static_cast<double>(counts.runs));
    }
    text += "\n";
  }
  return text;
}

std::string StepFigure(const std::vector<Group>& sizes) {
  std::string text =
      FigureHead(fmt::format("xlabel={{steps of a run ({} stands for more, too)}}, ylabel={{share of the "
                             "runs}}, legend pos=outer north east, no markers, const plot",
                             Tally::kBins - 1));
  for (const Group& size : sizes) {
    text += fmt::format(
        "\\addplot table[x=steps, y=c{0}] {{\\stictiondata/steps.dat}};\n\\addlegendentry{{{0} {1}}}\n",
        size.Number(1), size.Number(1) == 1 ? "contact" : "contacts");
  }
  return text + "\\end{axis}\n\\end{tikzpicture}\n";
}

std::string Document(const CampaignIdentity& identity) {
  std::string remarks;
  const Json told = RemarksOf(identity);
  for (const auto& [name, value] : told.items())
    remarks += fmt::format("\\\\\n{}: {}\n", LatexText(name), LatexText(PlainValue(value)));
  return fmt::format(R"(% Written by stiction: pdflatex report.tex, twice.
\documentclass[a4paper]{{article}}
\usepackage[utf8]{{inputenc}}
\usepackage[margin=2cm]{{geometry}}
\usepackage{{booktabs}}
\usepackage{{longtable}}
\usepackage{{pgfplots}}
\pgfplotsset{{compat=1.16}}
\title{{Endless runs of a contact force algorithm, as stiction counted them}}
\author{{}}
\date{{}}
\begin{{document}}
\maketitle
\noindent Seed {}, version {} of the algorithm.
{}\input{{loops.tex}}
\input{{contacts.tex}}
\input{{methods.tex}}
\begin{{figure}}\centering\input{{figure-loops.tex}}
\caption{{Loops confirmed exactly, by number of contacts, with exact intervals at 95\,\%; where none was met there is
no mark.}}\end{{figure}}
\begin{{figure}}\centering\input{{figure-steps.tex}}
\caption{{Steps of a run of the published algorithm, by number of contacts.}}\end{{figure}}
\end{{document}}
)",
                     identity.seed, identity.algorithm, remarks);
}

}  // namespace

std::map<std::string, std::string> LatexFiles(const Store& store) {
  const Record record = store.Total();
  const LoopCurves curves = LoopCurvesOf(record);
  std::vector<Group> sizes = GroupsBy(record, kBySize);
  std::erase_if(sizes, [](const Group& size) { return size.Text(0) != "paper"; });
  return {{"latex/report.tex", Document(store.identity())},
          {"latex/loops.tex", ToLatex(PaperLoops(record))},
          {"latex/contacts.tex", ToLatex(PaperContacts(record))},
          {"latex/methods.tex", ToLatex(PaperMethods(record))},
          {"latex/loops.dat", LoopData(curves)},
          {"latex/steps.dat", StepData(sizes)},
          {"latex/figure-loops.tex", LoopFigure(curves)},
          {"latex/figure-steps.tex", StepFigure(sizes)}};
}

std::string Citation(const Store& store) {
  std::string versions;  // "0.1.0 2060e9f249a5" of each build, whose compiler and flags follow
  for (const std::string& build : store.TotalWork().builds)
    versions += (versions.empty() ? "" : "; ") + build.substr(0, build.find(','));
  return fmt::format(R"(@misc{{stiction,
  author = {{{{The stiction authors}}}},
  title = {{stiction: a verification suite for the contact force algorithm of {{D.}} {{Baraff}}}},
  howpublished = {{Software, version {}}},
  note = {{Seed {}, version {} of the algorithm}}
}}

@inproceedings{{Baraff94,
  author = {{Baraff, David}},
  title = {{Fast Contact Force Computation for Nonpenetrating Rigid Bodies}},
  booktitle = {{Proceedings of SIGGRAPH 94}},
  year = {{1994}}
}}
)",
                     LatexText(versions), store.identity().seed, store.identity().algorithm);
}

}  // namespace stiction
