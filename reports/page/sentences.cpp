// SPDX-License-Identifier: Apache-2.0
// What a report found, in sentences.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "corpus/intervals.h"
#include "corpus/record/counts.h"
#include "corpus/record/kinds.h"
#include "reports/page/page.h"
#include "reports/tables/groups.h"

namespace stiction {
namespace {

// What was run.
struct Asking {
  std::set<int> contacts;
  std::set<std::string> generators;

  explicit Asking(const Record& total) {
    for (const Group& group : GroupsBy(total, {"generator", "contacts"})) {
      generators.insert(group.Text(0));
      contacts.insert(group.Number(1));
    }
  }
};

Html Sentence(const std::string& lead, const std::string& rest, const char* style = "") {
  return Tag("p", {{"class", style}})(Tag("strong")(lead) + Html(" ") + Text(rest)) + Html("\n");
}

std::string Spread(const std::set<int>& contacts) {
  return *contacts.begin() == *contacts.rbegin()
             ? Counted(*contacts.begin(), "contact")
             : fmt::format("{} to {} contacts", *contacts.begin(), *contacts.rbegin());
}

Html Asked(const ReportContent& content, const Counts& counts) {
  const Asking asking(content.total);
  if (asking.contacts.empty()) return Html();
  return Tag("p", {{"class", "asked"}})(
             fmt::format("Asked: does the algorithm, as published, always end? {} of {}, from {}, were run "
                         "under {}: {}.",
                         Counted(ProblemsOf(content.total), "random problem"), Spread(asking.contacts),
                         Counted(static_cast<std::int64_t>(asking.generators.size()), "generator"),
                         PoliciesText(content.total), Counted(counts.runs, "run"))) +
         Html("\n");
}

Html LoopsSentence(const Counts& sums) {
  const std::int64_t loops = sums.Loops();
  const std::string rate = RateText(loops, sums.runs);
  if (loops == 0)
    return Sentence(
        "No loop was seen.",
        fmt::format("No run that was repeated exactly goes on for ever: {} in a million runs.", rate), "claim");
  return Sentence(
      "It does not always end.",
      fmt::format(
          "{} of {} {} on for ever: {} in a million runs. In the plane they repeat a state, exactly; in space, "
          "as intervals prove, they repeat one or never leave a box.",
          Grouped(loops), Counted(sums.runs, "run"), loops == 1 ? "goes" : "go", rate),
      "claim");
}

Html GridSentence(const std::vector<Discovery>& discoveries) {
  std::int64_t finished = 0, found = 0, minimized = 0;
  int smallest = 0;
  for (const Discovery& discovery : discoveries) {
    if (!discovery.IsLoop() || !discovery.Finished() || !discovery.SawPolicies()) continue;
    ++finished;
    found += discovery.EveryPolicyLoops();
    minimized += discovery.minimized && discovery.minimized->grid.AllLoop();
    const int contacts = discovery.SmallestContacts();
    smallest = smallest == 0 ? contacts : std::min(smallest, contacts);
  }
  if (finished == 0) return Html();
  return Sentence(
      found + minimized > 0 ? "Not a matter of one policy." : "The policy matters.",
      fmt::format("Of {} of loops in the plane that {} certified and minimized, {} as minimized, and {} as "
                  "they were found, loop under every policy that stiction distinguishes; the smallest has {}.",
                  Counted(finished, "group"), finished == 1 ? "was" : "were", Grouped(minimized),
                  Grouped(found), Counted(smallest, "contact")));
}

Html OtherFailures(const Counts& sums) {
  const std::int64_t singular = sums.Of(Outcome::kSingular), rays = sums.Of(Outcome::kRay);
  if (singular + rays == 0) return Html();
  const auto part = [&sums](std::int64_t count, const char* what) {
    return fmt::format("{} {} ({} in a million)", Counted(count, "run"), what, RateText(count, sums.runs));
  };
  std::string text = "In exact arithmetic or, in space, over intervals ";
  if (singular > 0) text += part(singular, "come to a direction system without a solution");
  if (singular > 0 && rays > 0) text += ", and ";
  if (rays > 0) text += part(rays, "come to a step that nothing limits");
  return Sentence("Or it gets stuck.", text + ".");
}

Html CompleteSentence(const Record& total) {
  const ExistenceTally all = SumOf(total.existence);
  if (all.problems == 0) return Html();
  return Sentence(
      all.solved == all.problems ? "Solutions exist, and are found." : "Not all were solved.",
      fmt::format("Complete driving, which turns back where the published algorithm gives up, solved {} of "
                  "{} that were given to it, each solution verified exactly; on {} its path folds.",
                  Grouped(all.solved), Counted(all.problems, "problem"), Grouped(all.with_folds)));
}

Html AgreementSentence(const Record& total) {
  const AgreementTally all = SumOf(total.agreement);
  if (all.compared == 0) return Html();
  return Sentence(all.disagreements == 0 ? "The methods agree." : "The methods disagree.",
                  fmt::format("{} of {} {} a disagreement of the published algorithm, complete driving and "
                              "Lemke’s method.",
                              Grouped(all.disagreements), Counted(all.compared, "problem"),
                              all.disagreements == 1 ? "shows" : "show"));
}

Html LyingSentence(const Counts& sums) {
  if (sums.suspicious == 0) return Html();
  const std::int64_t refuted = sums.Of(Outcome::kSolved);
  std::string text = fmt::format(
      "Of {} in doubles {} solved in exact arithmetic ({}). ", Counted(sums.suspicious, "suspicious run"),
      Grouped(refuted) + (refuted == 1 ? " is" : " are"), ShareText(refuted, sums.suspicious));
  text += fmt::format("In {} ({} in a million) doubles end otherwise than exact arithmetic. ",
                      Counted(sums.doubles_differ, "run"), RateText(sums.doubles_differ, sums.runs));
  text += fmt::format("{} called solved what is no solution ({} in a million).", Counted(sums.wrong, "run"),
                      RateText(sums.wrong, sums.runs));
  if (sums.audited > 0)
    text += fmt::format(" Of {} without a suspicion that were repeated exactly, {} {} misjudged ({}).",
                        Counted(sums.audited, "run"), Grouped(sums.misjudged),
                        sums.misjudged == 1 ? "was" : "were", ShareText(sums.misjudged, sums.audited));
  return Sentence("Doubles lie.", text);
}

}  // namespace

Sentences SentencesOf(const ReportContent& content) {
  const Counts sums = CountAll(content.total);
  if (sums.runs == 0) return {};
  return {Asked(content, sums),
          LoopsSentence(sums),
          GridSentence(content.discoveries),
          OtherFailures(sums),
          CompleteSentence(content.total),
          AgreementSentence(content.total),
          LyingSentence(sums)};
}

}  // namespace stiction
