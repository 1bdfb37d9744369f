#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
#
# paper.sh PROGRAM RESULTS FOLDER [WIDTH_MM]: the figures of a swept study as a paper has them (PDF, grey, one column,
# no caption) and tables as tex, in a document of two columns that pdflatex compiles; pages as PNG to be looked at.
# Fails when LaTeX complains: an error, an undefined reference, a box that is too full, a figure that is too wide.
# Needs texlive-latex-recommended, poppler-utils (apt-get install --no-install-recommends). Not part of CI.

set -euo pipefail
program=$(realpath "$1") results=$(realpath "$2") width_mm=${4:-85}
mkdir -p "$3" && cd "$3"

"$program" figures "$results" -o figures --no_pictures --width_mm "$width_mm" --grey --no_caption >figures.txt
"$program" table "$results" --columns method --metric f1 --format tex >f1.tex
"$program" table "$results" --rows class --columns metric --metric precision,recall,f1 --format tex \
  $("$program" table "$results" --format json | python3 -c '
import json, shlex, sys
row = json.load(sys.stdin)["rows"][-1]
keys = list(row)[:list(row).index("method") + 1]
print(*(f"--where {key}={row[key]}" for key in keys[:-1]), "--method", row["method"])') >classes.tex

{
  cat <<'TEX'
\documentclass[twocolumn,a4paper]{article}
\usepackage[margin=15mm,columnsep=8mm]{geometry}
\usepackage{graphicx,booktabs}
\begin{document}
TEX
  for table in f1 classes; do
    printf '\\begin{table*}\\centering\\footnotesize\\input{%s.tex}\\caption{%s}\\end{table*}\n' $table $table
  done
  grep '\.pdf$' figures.txt | while read -r file; do
    printf '\\begin{figure}\\centering\\includegraphics{%s}\\caption{%s}\\end{figure}\n' \
      "figures/$(basename "$file")" "$(basename "$file" .pdf | tr _ ' ')"
  done
  echo '\end{document}'
} >paper.tex

pdflatex -interaction=nonstopmode -halt-on-error paper.tex >latex.txt || { tail -20 latex.txt >&2; exit 1; }
if grep -E '^(LaTeX Warning: (Reference|Float too large)|Overfull)' latex.txt >&2; then exit 1; fi
rm -f page-*.png
pdftoppm -r 100 -png paper.pdf page
ls "$PWD"/page-*.png
