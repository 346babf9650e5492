# usage: timeout 20 zsh complete.zsh FOLDER LINE PATTERN: types a line into a zsh that has the completion of FOLDER, and a tab; ends when what
# it shows has the pattern
zmodload zsh/zpty
zpty shell "COLUMNS=400 TERM=dumb zsh -f -i"
zpty -w shell "fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -D; zstyle ':completion:*' list-separator --"
zpty -w shell "LISTMAX=0; bindkey '^I' list-choices; print rea''dy"
zpty -r shell shown '*ready*'
zpty -w -n shell "$2"$'\t'
zpty -r shell shown "*$3*"
