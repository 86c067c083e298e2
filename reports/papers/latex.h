// SPDX-License-Identifier: Apache-2.0
// A report for papers: tables of booktabs and longtable, figures of PGFPlots that read their numbers from CSV
// files beside them; and an entry for BibTeX. Templates are in latex/.
//
//   latex/report.tex           a document of all of it: pdflatex report.tex
//   latex/loops.tex            exact rates of loops by generator and contacts, with intervals
//   latex/contacts.tex         what runs were like, by contacts: steps, zero steps, give-ups
//   latex/methods.tex          the methods by contacts: what was solved, and where they disagree
//   latex/figure-loops.tex     rates by contacts, with error bars; reads loops-1.csv, loops-2.csv, ...
//   latex/figure-steps.tex     steps of a run by contacts; reads steps.csv
//
// Tables have their numbers in them, since LaTeX cannot read the CSV files of a report: pgfplotstable takes the
// commas of a policy for columns, quoted or not, and % for a comment, and it would round intervals inward.

#pragma once

#include <map>
#include <string>

#include "corpus/store/store.h"

namespace stiction {

// Name -> text of the files above.
std::map<std::string, std::string> LatexFiles(const Store& store);

// BibTeX: the software, in the versions that worked on the store, and the paper that it examines.
std::string Citation(const Store& store);

}  // namespace stiction
