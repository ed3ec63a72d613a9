# completion.zsh FILE LINE: what zsh makes of the line when the tab key is pressed at its end, with
# the completion of gnomon in FILE. Started as `zsh -f`.
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell "PS1= PROMPT= RPS1= ; TERM=dumb; unset zle_bracketed_paste; stty -echo"
zpty -w shell "autoload -U compinit && compinit -D -u; setopt no_beep; gnomon() {}"
zpty -w shell "sed '\$d' ${(q)1} > $TMPPREFIX.$$; source $TMPPREFIX.$$; rm -f $TMPPREFIX.$$; compdef _gnomon gnomon"
zpty -w shell "show-line() { print -r -- \"<\$BUFFER>\"; zle kill-buffer; zle accept-line }; zle -N show-line; bindkey '^X' show-line; bindkey '^I' complete-word; print rea''dy"
zpty -r shell output '*ready*'
zpty -n -w shell "$2"$'\t'$'\x18'
zpty -r -m shell output '*<*>*'
print -r -- ${${output##*<}%%>*}
zpty -d shell
