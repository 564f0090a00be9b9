;;; sensedsl-mode.el --- Major mode for SenseDSL  -*- lexical-binding: t; -*-

;; Version: 0.1.0
;; Package-Requires: ((emacs "26.1"))
;; Keywords: languages
;; SPDX-License-Identifier: MIT OR Apache-2.0

;;; Commentary:

;; Colours, indentation and comments for `.sense' files, as `sensedsl fmt' lays them out, and the language server for
;; Eglot and lsp-mode.  Keywords are words only where the language has one, so what follows a word decides its colour.

;;; Code:

(require 'rx)

(defgroup sensedsl nil
  "Designs and drivers in SenseDSL."
  :group 'languages)

(defcustom sensedsl-server-command '("sensedsl" "lsp")
  "The language server and its arguments."
  :type '(repeat string))

(defcustom sensedsl-indent-offset 4
  "Spaces for each bracket that is open."
  :type 'integer
  :safe #'integerp)

(defconst sensedsl--units
  '("us" "ms" "s" "Hz" "kHz" "MHz" "mV" "V" "Ohm" "kOhm" "mm" "cm" "m" "deg" "degC" "mA" "A" "W" "rpm"
    "deg/s" "mm/s" "cm/s" "m/s" "m/s^2")
  "Units that are words; `%' is none.")

(defvar sensedsl-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 124b" table)
    (modify-syntax-entry ?* ". 23" table)
    (modify-syntax-entry ?\n "> b" table)
    (modify-syntax-entry ?\" "\"" table)
    (modify-syntax-entry ?\\ "\\" table)
    (modify-syntax-entry ?_ "_" table)
    (dolist (mark '(?+ ?- ?= ?% ?< ?> ?& ?| ?. ?^))
      (modify-syntax-entry mark "." table))
    (modify-syntax-entry ?' "." table)
    table)
  "What letters mean in SenseDSL.")

(eval-and-compile
  (defconst sensedsl--name "[A-Za-z_][A-Za-z0-9_]*")
  (defconst sensedsl--space "[ \t\n]+"))

(defconst sensedsl--number
  (concat "\\_<\\(0[xX][0-9A-Fa-f_]+\\|0[bB][01_]+"
          "\\|[0-9][0-9_]*\\(?:\\.[0-9][0-9_]*\\)?\\(?:[eE][+-]?[0-9][0-9_]*\\)?\\)"
          "\\(?:[ \t]*\\(?:\\(" (regexp-opt sensedsl--units) "\\)\\(?:[^A-Za-z0-9_]\\|\\'\\)\\|\\(%\\)\\)\\)?")
  "A number and its unit.")

(defconst sensedsl--step
  (concat "\\(?:^\\|[;{}]\\)[ \t]*\\(at\\|fault\\|always\\|never\\|eventually\\|when\\)"
          "\\(?:" sensedsl--space "[^ \t\n=]\\|[-+(]\\)")
  "What a step of a test begins with.")

(defun sensedsl--match-number (limit)
  "Find a number before LIMIT; a word such as 8N1 is none."
  (let (found)
    (while (and (not found) (re-search-forward sensedsl--number limit t))
      (goto-char (or (match-end 2) (match-end 3) (match-end 1)))
      (setq found (save-match-data
                    (save-excursion
                      (goto-char (match-beginning 1))
                      (let ((case-fold-search nil))
                        (or (looking-at-p "0X") (not (looking-at "[0-9]+\\(?:[ACDF-WYZ]\\|[A-Z][A-Z]+\\)[0-9]+\\_>"))))))))
    found))

(defun sensedsl--match-step (limit)
  "Find the first word of a step before LIMIT, in code."
  (let (found)
    (while (and (not found) (re-search-forward sensedsl--step limit t))
      (setq found (not (save-match-data (nth 8 (save-excursion (syntax-ppss (match-beginning 1))))))))
    found))

(defvar sensedsl-font-lock-keywords
  `(;; Heads: a keyword, the name, then what it is.
    ("\\_<\\(spare\\)\\_>[ \t\n]+board\\_>" (1 'font-lock-keyword-face))
    (,(concat "\\_<\\(board\\)" sensedsl--space "\\(" sensedsl--name "\\)"
              "\\(?:" sensedsl--space "\\(on\\)\\_>\\(?:" sensedsl--space "\\(" sensedsl--name "\\)\\)?\\)?")
     (1 'font-lock-keyword-face)
     (2 'font-lock-type-face)
     (3 'font-lock-keyword-face nil t)
     (4 'font-lock-constant-face nil t))
    (,(concat "\\_<\\(chip\\|driver\\|connection\\)" sensedsl--space "\\(" sensedsl--name "\\)"
              "\\(?:" sensedsl--space "\\(for\\)" sensedsl--space "\\(" sensedsl--name "\\)\\)?")
     (1 'font-lock-keyword-face)
     (2 'font-lock-type-face)
     (3 'font-lock-keyword-face nil t)
     (4 'font-lock-builtin-face nil t))
    (,(concat "\\_<\\(sensor\\|actuator\\|reading\\|command\\)" sensedsl--space "\\(" sensedsl--name "\\)"
              sensedsl--space "\\(returns\\|accepts\\)" sensedsl--space "\\(" sensedsl--name "\\)"
              "\\(?:\\[\\(" sensedsl--name "\\)\\]\\)?")
     (1 'font-lock-keyword-face)
     (2 'font-lock-function-name-face)
     (3 'font-lock-keyword-face)
     (4 'font-lock-builtin-face)
     (5 'font-lock-constant-face nil t))
    (,(concat "\\_<\\(controller\\)" sensedsl--space "\\(" sensedsl--name "\\)" sensedsl--space "\\(every\\)\\_>")
     (1 'font-lock-keyword-face)
     (2 'font-lock-function-name-face)
     (3 'font-lock-keyword-face))
    (,(concat "\\_<\\(test\\)" sensedsl--space "\\(" sensedsl--name "\\)")
     (1 'font-lock-keyword-face)
     (2 'font-lock-type-face))
    (,(concat "\\_<\\(const\\)" sensedsl--space "\\(" sensedsl--name "\\)")
     (1 'font-lock-keyword-face)
     (2 'font-lock-constant-face))
    ("\\_<\\(link\\)[ \t\n]*{" (1 'font-lock-keyword-face))
    ;; Statements.
    ("\\_<\\(use\\)[ \t\n]*\"" (1 'font-lock-keyword-face))
    (,(concat "\\_<\\(prefer\\|avoid\\)" sensedsl--space "[A-Za-z_]") (1 'font-lock-keyword-face))
    (,(concat "\\_<\\(allow\\)" sensedsl--space "\\(" sensedsl--name "\\)")
     (1 'font-lock-keyword-face)
     (2 'font-lock-constant-face))
    (,(concat "\\_<\\(reserve\\|release\\)" sensedsl--space "[A-Za-z_]")
     (1 'font-lock-keyword-face)
     ("[Pp][0-9]\\.[0-9]+\\|[A-Za-z_][A-Za-z0-9_]*"
      (progn (backward-char) (sensedsl--end-of-statement)) nil
      (0 'font-lock-constant-face)))
    ;; Steps of tests: words that join their pieces are words only there.
    (sensedsl--match-step
     (1 'font-lock-keyword-face)
     (,(concat "\\_<\\(set\\|of\\)" sensedsl--space "\\(" sensedsl--name "\\)"
               "\\|\\(" sensedsl--name "\\)("
               "\\|[A-Za-z0-9_]\\.\\(" sensedsl--name "\\)"
               "\\|\\_<\\(and\\|or\\|not\\|in\\|then\\|within\\|from\\|to\\|for\\|at\\)\\_>")
      (progn (backward-char) (sensedsl--end-of-statement)) nil
      (1 'font-lock-keyword-face nil t)
      (2 'font-lock-constant-face nil t)
      (3 'font-lock-builtin-face nil t)
      (4 'font-lock-variable-name-face nil t)
      (5 'font-lock-keyword-face nil t)))
    ;; Properties and values.
    (,(concat "\\_<\\(" sensedsl--name "\\)[ \t\n]*=\\(?:[^=]\\|\\'\\)") (1 'font-lock-variable-name-face))
    ("\\_<\\(raw\\)[ \t\n]+[+-]?[0-9]" (1 'font-lock-keyword-face))
    (sensedsl--match-number
     (1 'font-lock-constant-face)
     (2 'font-lock-builtin-face nil t)
     (3 'font-lock-builtin-face nil t)))
  "Colours of SenseDSL; words as values have none.")

(defun sensedsl--end-of-statement ()
  "The place of the `;' that comes next, or the end of the line."
  (save-excursion
    (if (re-search-forward ";" (line-end-position 4) t) (point) (line-end-position))))

(defun sensedsl-indent-line ()
  "Indent the line by the brackets that are open there."
  (interactive)
  (let* ((state (save-excursion (back-to-indentation) (syntax-ppss)))
         (closing (save-excursion
                    (back-to-indentation)
                    (let ((start (point))) (- (progn (skip-chars-forward "]})") (point)) start))))
         (column (* sensedsl-indent-offset (max 0 (- (car state) closing)))))
    (cond ((nth 8 state) 'noindent)
          ((<= (current-column) (current-indentation)) (indent-line-to column))
          (t (save-excursion (indent-line-to column))))))

(defvar sensedsl-imenu-generic-expression
  `((nil ,(concat "^[ \t]*\\(?:sensor\\|actuator\\|reading\\|command\\|controller\\)[ \t]+\\(" sensedsl--name "\\)") 1)
    ("Boards" ,(concat "^[ \t]*\\(?:spare[ \t]+\\)?board[ \t]+\\(" sensedsl--name "\\)") 1)
    ("Chips" ,(concat "^[ \t]*chip[ \t]+\\(" sensedsl--name "\\)") 1)
    ("Drivers" ,(concat "^[ \t]*driver[ \t]+\\(" sensedsl--name "\\)") 1)
    ("Tests" ,(concat "^[ \t]*test[ \t]+\\(" sensedsl--name "\\)") 1)
    ("Constants" ,(concat "^[ \t]*const[ \t]+\\(" sensedsl--name "\\)") 1))
  "What `imenu' lists.")

;;;###autoload
(define-derived-mode sensedsl-mode prog-mode "SenseDSL"
  "Major mode for designs and drivers in SenseDSL."
  (setq-local comment-start "// ")
  (setq-local comment-end "")
  (setq-local comment-start-skip "\\(?://+\\|/\\*+\\)[ \t]*")
  (setq-local font-lock-defaults '(sensedsl-font-lock-keywords nil nil nil))
  (setq-local font-lock-multiline t)
  (setq-local indent-line-function #'sensedsl-indent-line)
  (setq-local indent-tabs-mode nil)
  (setq-local electric-indent-chars (append "]})" electric-indent-chars))
  (setq-local imenu-generic-expression sensedsl-imenu-generic-expression)
  (setq-local imenu-case-fold-search nil))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.sense\\'" . sensedsl-mode))

(defvar eglot-server-programs)
(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs (cons 'sensedsl-mode sensedsl-server-command)))

(declare-function lsp-register-client "lsp-mode")
(declare-function make-lsp-client "lsp-mode")
(declare-function lsp-stdio-connection "lsp-mode")
(declare-function lsp-activate-on "lsp-mode")
(defvar lsp-language-id-configuration)
(with-eval-after-load 'lsp-mode
  (add-to-list 'lsp-language-id-configuration '(sensedsl-mode . "sensedsl"))
  (lsp-register-client
   (make-lsp-client :new-connection (lsp-stdio-connection (lambda () sensedsl-server-command))
                    :activation-fn (lsp-activate-on "sensedsl")
                    :server-id 'sensedsl)))

(provide 'sensedsl-mode)
;;; sensedsl-mode.el ends here
