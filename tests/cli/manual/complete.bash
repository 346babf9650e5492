# usage: bash complete.bash COMPLETION WORD...: what bash offers for the last word, one a line; bash hands "=" over as a word of its own
source "$1"
COMP_WORDS=("${@:2}")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_musim
printf '%s\n' "${COMPREPLY[@]}"
