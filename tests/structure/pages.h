// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace carom::structure {

/// Pages (*.md) by their path from the root of the project.
using Pages = std::map<std::string, std::string>;

/// The anchors of a page's headings, as GitHub makes them: small letters, hyphens for blanks, no punctuation; what comes again
/// gets a number.
std::set<std::string> anchorsOf(const std::string& page);

/// What a page links to, as written; not what stands in code.
std::vector<std::string> linksOf(const std::string& page);

/// A sentence for each link to a file that is not there (`exists`, by the path from the root), or to a heading that its page
/// does not have.
std::vector<std::string> deadLinks(const Pages& pages, const std::function<bool(const std::string&)>& exists);

/// A sentence for each page of docs/ that docs/index.md does not link to.
std::vector<std::string> pagesNotIndexed(const Pages& pages);

/// A sentence for each `name.cpp`, `name.hpp` or `name.h` of a page, alone or with folders before it, that ends no path.
std::vector<std::string> lostSources(const Pages& pages, const std::vector<std::string>& paths);

/// A sentence for each page whose first 16 lines have neither a picture nor code nor a table.
std::vector<std::string> pagesWithoutExample(const Pages& pages);

/// docs/decisions.md: at most 60 entries, numbered from 1, of at most five lines of at most 140 characters.
std::vector<std::string> decisionViolations(const std::string& page);

}  // namespace carom::structure
