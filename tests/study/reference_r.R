# SPDX-License-Identifier: MIT
# Figures of pairs of groups by R and its package coin, for reference_unit.cpp. Reads a file of lines of numbers, two
# lines a pair; writes lines "PAIR NAME VALUE". R's own exact tests know no ties: they are asked only where there are
# none, coin's wilcox_test everywhere.
suppressPackageStartupMessages(library(coin))

say <- function(pair, name, value) cat(pair, name, sprintf("%.17g", value), "\n")

compare <- function(pair, a, b) {
  data <- data.frame(value = c(a, b), group = factor(rep(c("a", "b"), c(length(a), length(b)))))
  if (length(unique(data$value)) > 1) {
    exact <- wilcox_test(value ~ group, data = data, distribution = exact(algorithm = "split-up"))
    say(pair, "u_exact_p", as.numeric(pvalue(exact)))
  }
  if (anyDuplicated(data$value) > 0) return()
  test <- wilcox.test(a, b, exact = TRUE, conf.int = TRUE, conf.level = 0.9)
  say(pair, "u", test$statistic)
  say(pair, "shift", test$estimate)
  say(pair, "shift_low", test$conf.int[1])
  say(pair, "shift_high", test$conf.int[2])
}

correlate <- function(pair, x, y) {
  if (length(x) < 3 || length(x) > 9 || anyDuplicated(x) > 0 || anyDuplicated(y) > 0) return()
  test <- cor.test(x, y, method = "spearman", exact = TRUE)
  say(pair, "r", test$estimate)
  say(pair, "r_exact_p", test$p.value)
}

# The values of x and y at one place are two trials of one participant.
agree <- function(pair, x, y) {
  n <- length(x)
  if (n < 2 || all(x == y)) return()
  data <- data.frame(value = c(x, y), participant = factor(rep(seq_len(n), 2)))
  squares <- anova(lm(value ~ participant, data = data))[["Mean Sq"]]
  ratio <- squares[1] / squares[2]
  low <- ratio / qf(0.975, n - 1, n)
  high <- ratio * qf(0.975, n, n - 1)
  say(pair, "icc", (squares[1] - squares[2]) / (squares[1] + squares[2]))
  say(pair, "icc_low", (low - 1) / (low + 1))
  say(pair, "icc_high", (high - 1) / (high + 1))
}

lines <- lapply(strsplit(readLines(commandArgs(trailingOnly = TRUE)[1]), " ", fixed = TRUE), as.numeric)
for (pair in seq_len(length(lines) / 2)) {
  a <- lines[[2 * pair - 1]]
  b <- lines[[2 * pair]]
  common <- seq_len(min(length(a), length(b)))
  compare(pair - 1, a, b)
  correlate(pair - 1, a[common], b[common])
  agree(pair - 1, a[common], b[common])
}
